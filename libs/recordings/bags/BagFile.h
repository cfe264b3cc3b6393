#pragma once
#include <hagen/recordings/BrokenRecording.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::recordings {

/// A topic of a bag.
struct BagTopic {
    std::string name;      ///< "/velodyne_points"
    std::string type;      ///< as in ROS 1, also of ROS 2: "sensor_msgs/PointCloud2"
    std::string encoding;  ///< "ros1", "cdr", or what the bag says

    bool operator==(const BagTopic& other) const {
        return name == other.name && type == other.type && encoding == other.encoding;
    }
};

/// A message, as its publisher serialised it.
struct BagMessage {
    std::size_t topic = 0;                ///< index in BagFile::topics()
    std::int64_t time_ns = 0;             ///< when it was recorded, since 1970
    const std::uint8_t* bytes = nullptr;  ///< valid until the next one is read
    std::size_t size = 0;
};

/// Reads the messages of a ROS recording one by one, in the order of the file. Memory grows with
/// the largest chunk and message, not with the file.
class BagFile {
 public:
    virtual ~BagFile() = default;

    /// Reads the next message; false at the end. Throws BrokenRecording.
    virtual bool next(BagMessage& message) = 0;
    /// Those seen so far; indices do not change.
    virtual const std::vector<BagTopic>& topics() const = 0;
    /// Fraction of the recording read so far, 0 ... 1.
    virtual double fractionRead() const = 0;
    /// What the user should know of how it is read.
    virtual std::vector<std::string> remarks() const { return {}; }
    /// Calls `check` again and again while next() reads: what it throws ends next(), which may read
    /// a whole file in search of a message. At most a chunk is read between two calls.
    virtual void checkWhileReading(const std::function<void()>& check) { check_ = check; }

 protected:
    void check() const {
        if (check_) check_();
    }

 private:
    std::function<void()> check_;
};

/// Whether a file begins like a ROS 1 bag, an MCAP or an SQLite database, whatever its name; of a
/// folder, whether it is a ROS 2 bag: it has a metadata.yaml of one, or else .mcap or .db3 files.
bool isBag(const std::filesystem::path& file_or_folder);

/// Opens a ROS 1 bag (format 2.0), an MCAP, a ROS 2 database (.db3), or a folder of the latter two.
/// Throws BrokenRecording naming a file that cannot be opened or has another format.
std::unique_ptr<BagFile> openBag(const std::filesystem::path& file_or_folder);

}  // namespace hagen::recordings
