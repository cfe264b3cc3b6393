// Rawlogs with the compression of different MRPT versions: none, gzip, zstd.
#include <gmock/gmock.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/RawlogReader.h>
#include <hagen/recordings/ScanSource.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <zstd.h>
#include "convert/RawlogWriter.h"

#include "support/Program.h"
#include "support/Random.h"
#include "support/ReadRawlog.h"

namespace hagen::recordings {
namespace {

using test::readLog;
using testing::HasSubstr;

/// The entries of a log: comments with random text, 30 kB each.
std::string plainLog(int entries) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    test::Random random(9);
    for (int i = 0; i < entries; ++i) {
        mrpt::obs::CObservationComment comment;
        comment.timestamp = mrpt::Clock::fromDouble(1.0);
        for (int k = 0; k < 30000; ++k) {
            comment.text += static_cast<char>('a' + random.whole(0, k < 15000 ? 25 : 1));
        }
        archive << comment;
    }
    return {static_cast<const char*>(stream.getRawBufferData()),
            static_cast<std::size_t>(stream.getTotalBytesCount())};
}

std::string zstdOf(const std::string& bytes, bool has_checksum = false) {
    const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context(ZSTD_createCCtx(),
                                                                          ZSTD_freeCCtx);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, has_checksum ? 1 : 0);
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(
        ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size()));
    return packed;
}

TEST(PackedRawlog, ReadsEveryCompression) {
    const test::TemporaryFolder folder;
    const std::string plain = plainLog(20), packed = zstdOf(plain);
    EXPECT_LT(packed.size(), plain.size());
    const std::pair<std::size_t, std::string> all(20, "");
    EXPECT_EQ(readLog(folder.write("plain", plain)), all);
    EXPECT_EQ(readLog(folder.write("zstd", packed)), all);
    EXPECT_EQ(readLog(folder.write("checked", zstdOf(plain, true))), all);
    // Consecutive frames may end anywhere.
    EXPECT_EQ(readLog(folder.write("frames", zstdOf(plain.substr(0, 70000)) + zstdOf("") +
                                                 zstdOf(plain.substr(70000)))),
              all);
    EXPECT_EQ(readLog(folder.write("twice", packed + packed)).first, 40u);
}

TEST(PackedRawlog, ReadsTruncatedZstdLog) {
    const test::TemporaryFolder folder;
    const std::string packed = zstdOf(plainLog(20));
    std::size_t max = 0;
    for (std::size_t cut = 0; cut < 50; ++cut) {
        const std::size_t size = 16 + cut * (packed.size() - 17) / 49;
        const auto [entries, broken] = readLog(folder.write("cut", packed.substr(0, size)));
        EXPECT_THAT(broken, HasSubstr("cut: entry " + std::to_string(entries) + " at byte "));
        EXPECT_THAT(broken, HasSubstr("Truncated zstd input"));
        EXPECT_GE(entries, max);
        max = entries;
    }
    EXPECT_GE(max, 10u);
}

TEST(PackedRawlog, ReportsDamagedZstdLog) {
    const test::TemporaryFolder folder;
    std::string packed = zstdOf(plainLog(20), true);
    packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 0x10);
    EXPECT_NE(readLog(folder.write("damaged", packed)).second, "");
    EXPECT_NE(readLog(folder.write("behind", zstdOf(plainLog(2)) + "something else")).second, "");
    EXPECT_NE(readLog(folder.write("magic", "\x28\xb5\x2f\xfd")).second, "");
    // A frame with a window of 256 MiB and an empty final block.
    const std::string long_window("\x28\xb5\x2f\xfd\x00\x90\x01\x00\x00", 9);
    EXPECT_THAT(readLog(folder.write("long", long_window)).second,
                HasSubstr("requires too much memory for decoding; try to decompress it with zstd"));
}

TEST(PackedRawlog, ReadsMrpt3Logs) {
    const auto folder = test::dataFolder("HAGEN_MRPT3_DATA");
    if (folder.empty()) GTEST_SKIP() << "HAGEN_MRPT3_DATA is not a folder of MRPT 3 logs";
    for (const char* name :
         {"sample_mrpt3.rawlog", "sample_mrpt3_gzip.rawlog", "sample_mrpt3_simple_gzip.rawlog"}) {
        SCOPED_TRACE(name);
        const auto source = openRecording(folder / name);
        const auto packets = source->nextScan();
        const auto cloud = source->nextScan();
        ASSERT_TRUE(packets && cloud);
        EXPECT_FALSE(source->nextScan());
        EXPECT_EQ(source->scansKnown(), 2u);
        EXPECT_EQ(cloud->observation->sensorLabel, "cloud");
        // MRPT created the cloud from these packets.
        auto scan = *std::dynamic_pointer_cast<const mrpt::obs::CObservationVelodyneScan>(
            packets->observation);
        scan.generatePointCloud();
        Scan points;
        ASSERT_TRUE(observations::readCloudPoints(*cloud->observation, points));
        EXPECT_THAT(points.x_m, testing::ElementsAreArray(scan.point_cloud.x));
        EXPECT_THAT(points.y_m, testing::ElementsAreArray(scan.point_cloud.y));
        EXPECT_THAT(points.z_m, testing::ElementsAreArray(scan.point_cloud.z));
        // The written log can be read again.
        const test::TemporaryFolder out;
        convert::RawlogWriter writer(out / "a.rawlog", false);
        writer.write(*cloud->observation);
        writer.commit();
        Scan again;
        const auto entry = RawlogReader(out / "a.rawlog").next();
        observations::readCloudPoints(dynamic_cast<const mrpt::obs::CObservation&>(*entry), again);
        EXPECT_EQ(again.x_m, points.x_m);
        EXPECT_EQ(again.intensity, points.intensity);
    }
}

}  // namespace
}  // namespace hagen::recordings
