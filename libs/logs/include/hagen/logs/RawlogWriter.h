#pragma once
#include <hagen/logs/GzipOutput.h>
#include <hagen/logs/OutputPath.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <filesystem>

namespace hagen {

/// Writes a rawlog that appears under its name when whole.
class RawlogWriter {
 public:
    /// Throws std::runtime_error, naming the file; see OutputPath.
    RawlogWriter(const std::filesystem::path& file, bool overwrite);

    /// Throws std::runtime_error, naming the file, where the entry cannot be written; a full disk
    /// may show some entries late, or with commit() alone.
    void write(const mrpt::serialization::CSerializable& entry);

    /// Ends the file and gives it its name.
    void commit();
    /// Ends the file as OUT.partial.rawlog and returns that name.
    std::filesystem::path keepPartial();

 private:
    OutputPath path_;
    GzipOutput stream_;
    mrpt::serialization::CArchive::UniquePtr archive_;
};

}  // namespace hagen
