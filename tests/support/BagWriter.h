#pragma once
#include <mrpt/obs/CObservationVelodyneScan.h>

#include "support/CaptureWriter.h"

namespace hagen::test {

/// The bytes of a ROS 1 or CDR message, appended field by field.
class MessageBytes {
 public:
    explicit MessageBytes(bool is_cdr) : is_cdr_(is_cdr) {
        if (is_cdr) bytes_ = std::string("\0\1\0\0", 4);
    }
    template <class Number>
    MessageBytes& number(Number value) {
        if (is_cdr_)
            bytes_.resize((bytes_.size() + sizeof value - 5) / sizeof value * sizeof value + 4);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    MessageBytes& text(const std::string& text) {
        number(static_cast<std::uint32_t>(text.size() + is_cdr_));
        bytes_ += text;
        if (is_cdr_) bytes_ += '\0';
        return *this;
    }
    /// Appends a fixed number of bytes; counted() writes their number first.
    MessageBytes& raw(const ByteString& bytes) {
        bytes_ += bytes;
        return *this;
    }
    MessageBytes& counted(const ByteString& bytes) {
        return number(static_cast<std::uint32_t>(bytes.size())).raw(bytes);
    }
    MessageBytes& time(double time_s);
    MessageBytes& header(double time_s, const std::string& frame);
    /// Adds a position and a rotation about z.
    MessageBytes& pose(double x, double y, double z, double yaw_rad = 0);
    const ByteString& bytes() const { return bytes_; }

 private:
    bool is_cdr_;
    ByteString bytes_;
};

/// A message to write, in both serialisations.
struct SentMessage {
    std::string topic, type;  ///< type, e.g. "sensor_msgs/PointCloud2"
    double time_s = 0;        ///< time of recording
    ByteString ros1, cdr;
};

/// Serialises a message both ways; `write` receives the MessageBytes.
template <class Write>
SentMessage sentMessage(const std::string& topic, const std::string& type, double time_s,
                        const Write& write) {
    SentMessage message{topic, type, time_s, {}, {}};
    MessageBytes ros1(false), cdr(true);
    write(ros1);
    write(cdr);
    message.ros1 = ros1.bytes();
    message.cdr = cdr.bytes();
    return message;
}

/// A cloud with the fields x, y, z and intensity (float32).
SentMessage cloudMessage(const std::string& topic, double time_s, const std::string& frame,
                         const std::vector<float>& xyzi);
/// A velodyne_msgs/VelodyneScan with the packets of a scan.
SentMessage velodyneMessage(const std::string& topic, double time_s, const std::string& frame,
                            const mrpt::obs::CObservationVelodyneScan& scan, double period_s);
/// A pandar_msgs/PandarScan.
SentMessage hesaiMessage(const std::string& topic, double time_s, const std::string& frame,
                         const std::vector<std::string>& packets, double period_s);
SentMessage odometryMessage(const std::string& topic, double time_s, const std::string& frame,
                            const std::string& child, double x, double y, double z);
/// A single transform on /tf or /tf_static.
SentMessage transformMessage(const std::string& topic, double time_s, const std::string& parent,
                             const std::string& child, double x, double y, double z);
SentMessage stringMessage(const std::string& topic, double time_s, const std::string& text);

/// Options for writing a bag; sizes and CRCs are always correct.
struct BagShape {
    std::string compression = "none";    ///< "none", "bz2", "lz4", "zstd", or invalid
    std::size_t messages_per_chunk = 4;  ///< MCAP only; 0: no chunks
    bool is_closed = true;               ///< whether a ROS 1 bag has an index
};

/// Bytes of a ROS 1 bag, and of an MCAP with ROS 2 (or ROS 1) messages.
ByteString ros1BagOf(const std::vector<SentMessage>& messages, const BagShape& shape = {});
ByteString mcapOf(const std::vector<SentMessage>& messages, const BagShape& shape = {},
                  bool is_ros1 = false);
std::filesystem::path writeDb3(const std::filesystem::path& file,
                               const std::vector<SentMessage>& messages);

/// Compresses bytes by "bz2", "lz4" or "zstd"; other names leave them unchanged.
ByteString packed(const ByteString& plain, const std::string& compression);

/// Records of a ROS 1 bag and of an MCAP.
ByteString ros1Record(const std::vector<std::pair<std::string, ByteString>>& fields,
                      const ByteString& data);
ByteString mcapRecord(unsigned op, const ByteString& content);

}  // namespace hagen::test
