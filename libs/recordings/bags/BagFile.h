#pragma once
#include <hagen/recordings/BrokenRecording.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hagen::recordings {

struct BagTopic {
    std::string name;      ///< such as "/velodyne_points"
    std::string type;      ///< in ROS 1 style even for ROS 2: "sensor_msgs/PointCloud2"
    std::string encoding;  ///< "ros1", "cdr", or another name found in the bag

    bool operator==(const BagTopic& other) const {
        return name == other.name && type == other.type && encoding == other.encoding;
    }
};

struct BagMessage {
    std::size_t topic = 0;                ///< index in BagFile::topics()
    std::int64_t time_ns = 0;             ///< recording time since 1970
    const std::uint8_t* bytes = nullptr;  ///< valid until the next message is read
    std::size_t size = 0;
};

/// Reads the messages of a ROS recording one by one, in file order. Memory use depends on the
/// largest chunk and message, not on the file size.
class BagFile {
 public:
    virtual ~BagFile() = default;

    /// Reads the next message; returns false at the end. Throws BrokenRecording.
    virtual bool next(BagMessage& message) = 0;
    /// The topics found so far; their indices do not change.
    virtual const std::vector<BagTopic>& topics() const = 0;
    /// Fraction of the recording read so far, 0 ... 1.
    virtual double fractionRead() const = 0;
    /// Describes a damaged chunk that next() has skipped since the last call; "" if there is none.
    virtual std::string takeDamage() { return ""; }
    /// Remarks for the user on how the bag was read.
    virtual std::vector<std::string> remarks() const { return {}; }
    /// Calls `check` repeatedly during next(), because next() may search the whole file for a
    /// message. Exceptions of `check` leave next(). Reads at most one chunk between two calls.
    virtual void checkWhileReading(const std::function<void()>& check) { check_ = check; }

 protected:
    void check() const {
        if (check_) check_();
    }

 private:
    std::function<void()> check_;
};

/// True if a file starts like a ROS 1 bag, an MCAP or an SQLite database, regardless of its name,
/// or if a folder is a ROS 2 bag: it has a bag's metadata.yaml, or .mcap or .db3 files.
bool isBag(const std::filesystem::path& file_or_folder);

/// Opens a ROS 1 bag (format 2.0), an MCAP, a ROS 2 database (.db3), or a folder of MCAPs or
/// databases. Throws BrokenRecording naming the file if it cannot be opened or has another format.
std::unique_ptr<BagFile> openBag(const std::filesystem::path& file_or_folder);

}  // namespace hagen::recordings
