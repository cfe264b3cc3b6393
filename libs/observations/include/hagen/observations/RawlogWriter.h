#pragma once
#include <hagen/observations/OutputPath.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <filesystem>

namespace hagen {

/// Writes a rawlog (gzip level 1, what MRPT's own tools do) that appears under its name when whole.
class RawlogWriter {
 public:
    /// Throws std::runtime_error, naming the file; see OutputPath.
    RawlogWriter(const std::filesystem::path& file, bool overwrite);

    /// Throws std::runtime_error where the entry cannot be written. MRPT's stream packs what it is
    /// given first, so that a full disk may show some entries later, and not at all in the last.
    void write(const mrpt::serialization::CSerializable& entry);

    /// Ends the file and gives it its name.
    void commit();
    /// Ends the file as OUT.partial.rawlog and returns that name.
    std::filesystem::path keepPartial();

 private:
    OutputPath path_;
    mrpt::io::CFileGZOutputStream stream_;
    mrpt::serialization::CArchive::UniquePtr archive_;
};

}  // namespace hagen
