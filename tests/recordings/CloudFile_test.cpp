#include "recordings/clouds/CloudFile.h"
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/CloudFiles.h"
#include "support/PointColumn.h"
#include "support/Program.h"
#include "support/Random.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
using observations::PointTable;
using test::column;
using test::FilePoint;
using test::filePoints;
using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class CloudFileTest : public testing::Test {
 protected:
    fs::path write(const std::string& name, const std::string& text) const {
        return folder_.write(name, text);
    }
    CloudFile read(const std::string& name, const std::string& text) const {
        return readCloud(write(name, text));
    }
    /// The error message for a file; empty if the file is readable.
    std::string complaint(const std::string& name, const std::string& text) const {
        const auto message = test::messageOf<BrokenRecording>([&] { read(name, text); });
        EXPECT_THAT(message, AnyOf("", HasSubstr((folder_ / name).string() + ": ")));
        return message;
    }

    const test::TemporaryFolder folder_;
};

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

TEST_F(CloudFileTest, ReadsEveryFormat) {
    const std::vector<FilePoint> points = filePoints();
    for (const auto& [name, text] : test::cloudFiles(points)) {
        SCOPED_TRACE(name);
        const PointTable table = read(name, text).table;
        ASSERT_EQ(table.points, points.size());
        const auto x = column(table, "x"), y = column(table, "y"), z = column(table, "z");
        const bool is_las = name.find(".las") != std::string::npos;
        const bool is_bin = name.find(".bin") != std::string::npos;
        const auto rings = column(table, is_las || is_bin ? "intensity" : "ring");
        const auto times =
            is_bin ? std::vector<double>() : column(table, is_las ? "gps_time" : "t");
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_NEAR(x[i], points[i].x_m, 1e-9);
            EXPECT_NEAR(y[i], points[i].y_m, 1e-9);
            EXPECT_NEAR(z[i], points[i].z_m, 1e-9);
            EXPECT_EQ(rings[i], is_las   ? 1000 + points[i].ring
                                : is_bin ? 0.25 * points[i].ring
                                         : points[i].ring);
            if (!is_bin) {
                EXPECT_DOUBLE_EQ(times[i], (is_las ? 1e-9 : 1.0) * points[i].t_ns);
            }
        }
    }
}

/// A sparse file may exceed all memory.
TEST_F(CloudFileTest, RejectsTooLargeFile) {
    const fs::path file = write("huge.bin", "");
    fs::resize_file(file, (std::uintmax_t{2} << 30) + 1);
    EXPECT_THAT(test::messageOf<BrokenRecording>([&] { readCloud(file); }),
                HasSubstr("huge.bin: is larger than 2 GiB"));
}

/// Rejects a map before allocating memory for its points.
TEST_F(CloudFileTest, RejectsTooManyPoints) {
    const std::string count = "16777217";
    const std::string npy =
        test::npy("{'descr': '|u1', 'fortran_order': False, 'shape': (" + count + ", 3), }", "");
    const std::string pcd = "FIELDS x y z\nSIZE 1 1 1\nTYPE U U U\nCOUNT 1 1 1\nWIDTH " + count +
                            "\nHEIGHT 1\nPOINTS " + count + "\nDATA binary\n";
    const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " + count +
                            "\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n";
    for (const std::string& header : {npy, pcd, ply}) {
        const fs::path file = write("map", header);
        fs::resize_file(file, header.size() + 3 * 16777217);
        EXPECT_THAT(test::messageOf([&] { readCloud(file); }),
                    HasSubstr("map: has 16777217 points; a scan may have at most 16777216; "
                              "is it a map of many scans?"))
            << header;
    }
}

TEST_F(CloudFileTest, DetectsFormatByContent) {
    const auto format = [&](const std::string& text) { return cloudFormatOf(write("file", text)); };
    EXPECT_EQ(format(test::asciiPcd(filePoints())), CloudFormat::Pcd);
    EXPECT_EQ(format("VERSION 0.7\nFIELDS x\n"), CloudFormat::Pcd);
    EXPECT_EQ(format(test::asciiPly(filePoints())), CloudFormat::Ply);
    EXPECT_EQ(format(test::las(filePoints())), CloudFormat::Las);
    EXPECT_EQ(format(test::structuredNpy(filePoints())), CloudFormat::Npy);
    EXPECT_EQ(format(test::bin(filePoints())), CloudFormat::Bin);
    EXPECT_EQ(format(test::bin(filePoints()) + "1234"), std::nullopt);
    EXPECT_EQ(format(test::bin({{2000.0f, 0, 0, 0, 0}})), std::nullopt);
    EXPECT_EQ(format(std::string(160, '\0')), std::nullopt);
    EXPECT_EQ(format("A text of 32 bytes is no cloud.\n"), std::nullopt);
    EXPECT_EQ(format(""), std::nullopt);
    EXPECT_EQ(cloudFormatOf(folder_.path()), std::nullopt);
    EXPECT_EQ(cloudFormatOf(folder_ / "missing"), std::nullopt);
}

TEST_F(CloudFileTest, IgnoresFileName) {
    EXPECT_EQ(read("las.bin", test::las(filePoints())).table.points, 12u);
    EXPECT_EQ(read("points", test::bin(filePoints())).table.points, 12u);
    EXPECT_TRUE(hasCloudName("a/B.PCD"));
    EXPECT_FALSE(hasCloudName("a/times.txt"));
}

/// A truncated file is rejected, unless only digits of its last number are missing.
TEST_F(CloudFileTest, RejectsTruncatedFile) {
    for (const auto& [name, text] : test::cloudFiles()) {
        for (std::size_t k = 0; k < 50; ++k) {
            const std::size_t size = k * (text.size() - 1) / 49;
            const std::string cut = text.substr(0, size);
            const bool is_shorter_bin = name == "points.bin" && size % 16 == 0;
            // Bytes after the vertices are not read; digits of the last number may be missing.
            const std::size_t unread = name == "ascii.ply" ? 6 : name == "ascii.pcd" ? 7 : 5;
            const bool may_be_whole = name.find(".ply") != std::string::npos || name == "ascii.pcd"
                                          ? size + unread >= text.size()
                                          : is_shorter_bin;
            if (may_be_whole) continue;
            EXPECT_THAT(complaint(name, cut), testing::Not(IsEmpty())) << name << " " << size;
        }
    }
}

/// With any wrong byte in header or data, reading either succeeds or reports an error.
TEST_F(CloudFileTest, SurvivesWrongBytes) {
    for (const auto& [name, text] : test::cloudFiles(filePoints(3))) {
        for (std::size_t at = 0; at < text.size(); at += 4) {
            std::string changed = text;
            changed[at] = std::string("\0009\xff", 3)[at % 3];
            try {
                const PointTable table = read(name, changed).table;
                EXPECT_LE(table.points * table.bytes_per_point, 8 * text.size());
            } catch (const BrokenRecording&) {
            }
        }
    }
}

TEST_F(CloudFileTest, RejectsAbsurdPointCounts) {
    const std::string max = "18446744073709551615";
    for (const auto& [name, text] : test::cloudFiles()) {
        SCOPED_TRACE(name);
        std::string absurd = text;
        if (name.find(".pcd") != std::string::npos) {
            absurd =
                replaced(replaced(text, "WIDTH 12", "WIDTH " + max), "POINTS 12", "POINTS " + max);
        } else if (name.find(".ply") != std::string::npos) {
            absurd = replaced(text, "vertex 12", "vertex " + max);
        } else if (name.find(".npy") != std::string::npos) {
            absurd = replaced(text, "(12,)", "(" + max + ",)");
            absurd = replaced(absurd, std::string(max.size() - 2, ' '), "");
        } else if (name.find(".las") != std::string::npos) {
            absurd.replace(107, 4, "\xff\xff\xff\xff");
            if (name == "new.las") absurd.replace(247, 8, std::string(8, '\xff'));
        } else {
            continue;  // has no header
        }
        EXPECT_THAT(complaint(name, absurd), HasSubstr("; is it truncated"));
    }
}

/// The size of fields is limited even without points, when the file needs no data.
TEST_F(CloudFileTest, RejectsAbsurdFields) {
    EXPECT_THAT(complaint("a.pcd",
                          "FIELDS x y z a\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 4000000000\n"
                          "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA binary\n"),
                AllOf(HasSubstr("'a' (4000000000 times float32)"), HasSubstr("damaged")));
    EXPECT_THAT(complaint("a.npy", test::npy("{'descr': [('x', '<f4', (288230376151711744,))], "
                                             "'fortran_order': False, 'shape': (0,), }",
                                             "")),
                HasSubstr("'x' (288230376151711744 times float32)"));
}

// PCD

TEST_F(CloudFileTest, PcdIgnoresPadding) {
    const CloudFile cloud = read("a.pcd", test::binaryPcd(filePoints()));
    EXPECT_EQ(namesOf(cloud.table), "x, y, z, ring, t");
    EXPECT_THAT(cloud.remarks, IsEmpty());
}

TEST_F(CloudFileTest, PcdAcceptsShortHeader) {
    const CloudFile cloud = read("a.pcd",
                                 "VERSION 0.6\r\nCOLUMNS x y z\r\nSIZE 4 4 8\r\nTYPE F F F\r\n"
                                 "WIDTH 2\r\nDATA ascii\r\n1 2 3\r\n\r\n nan\t-inf +7\r\n");
    EXPECT_EQ(cloud.table.points, 2u);
    EXPECT_TRUE(std::isnan(column(cloud.table, "x")[1]));
    EXPECT_EQ(column(cloud.table, "y")[1], -std::numeric_limits<double>::infinity());
    EXPECT_THAT(column(cloud.table, "z"), ElementsAre(3, 7));
}

TEST_F(CloudFileTest, PcdAcceptsShortestText) {
    const std::string header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA ascii\n";
    EXPECT_THAT(column(read("a.pcd", header + "1 2 3").table, "z"), ElementsAre(3));
    EXPECT_THAT(complaint("a.pcd", header + "1 2"), HasSubstr("is it truncated?"));
}

TEST_F(CloudFileTest, PcdReportsViewpointAndTrailingBytes) {
    const std::string moved =
        replaced(test::binaryPcd(filePoints()), "VIEWPOINT 0 0 0", "VIEWPOINT 0 0 2");
    const CloudFile cloud = read("a.pcd", moved + "more");
    EXPECT_THAT(cloud.remarks, ElementsAre(HasSubstr("4 bytes after"), HasSubstr("its VIEWPOINT")));
}

TEST_F(CloudFileTest, PcdErrorsIncludeLine) {
    const std::string text = test::asciiPcd(filePoints());
    const auto complaintOn = [&](const std::string& what, const std::string& with) {
        return complaint("a.pcd", replaced(text, what, with));
    };
    EXPECT_THAT(complaintOn("DATA ascii", "DATA binary_zip"),
                AllOf(HasSubstr("line 11"), HasSubstr("binary_zip")));
    EXPECT_THAT(complaintOn("SIZE 4 4", "SIZE 4"), HasSubstr("line 4: expected one value per "
                                                             "field (6), found 5"));
    EXPECT_THAT(complaintOn("SIZE 4", "SIZE 3"), HasSubstr("TYPE F and SIZE 3"));
    EXPECT_THAT(complaintOn("COUNT 1", "COUNT x"), HasSubstr("'x' is not a valid COUNT"));
    EXPECT_THAT(complaintOn("WIDTH 12", "WIDTH 13"), HasSubstr("WIDTH times HEIGHT is 13"));
    EXPECT_THAT(complaintOn("HEIGHT 1", "HEIGHTS 1"), HasSubstr("line 8: 'HEIGHTS'"));
    EXPECT_THAT(complaintOn("HEIGHT 1", "WIDTH 1"), HasSubstr("line 8: WIDTH occurs twice"));
    EXPECT_THAT(complaintOn("1.500000 ", "1.5x "),
                HasSubstr("line 12: '1.5x' is not a valid float32"));
    EXPECT_THAT(complaintOn(" 70000\n", " 7e10\n"),
                HasSubstr("line 13: '7e10' is not a valid uint32"));
    EXPECT_THAT(complaintOn(" 70000\n", "\n"), HasSubstr("line 13: expected 9 numbers, found 8"));
    EXPECT_THAT(complaintOn("x y z", "x x z"), HasSubstr("'x' occurs twice"));
    EXPECT_THAT(complaintOn("COUNT 1", "COUNT 4294967295"), HasSubstr("bytes are left"));
}

TEST_F(CloudFileTest, PcdChecksCompressedSizes) {
    std::string text = test::compressedPcd(filePoints());
    const std::size_t sizes = text.find("binary_compressed\n") + 18;
    const auto with = [&](std::size_t at, const std::string& bytes) {
        std::string changed = text;
        return complaint("a.pcd", changed.replace(sizes + at, bytes.size(), bytes));
    };
    EXPECT_THAT(with(0, "\xff\xff\xff\xff"), HasSubstr("is it truncated"));
    EXPECT_THAT(with(4, "\xff\xff\xff\xff"), HasSubstr("cannot expand to 4294967295"));
    EXPECT_THAT(with(4, std::string("\x10\0\0\0", 4)), HasSubstr("bytes are left"));
    EXPECT_THAT(with(4, std::string("\x10\x7f\0\0", 4)),
                HasSubstr("but the header claims 12 points of 22 bytes"));
    EXPECT_THAT(with(8, "\xff\xff"), HasSubstr("cannot be decompressed"));
}

TEST_F(CloudFileTest, PcdReadsUncompressedData) {
    const std::vector<FilePoint> points = filePoints();
    const std::string binary = test::binaryPcd(points), packed = test::compressedPcd(points);
    const CloudFile plain =
        read("a.pcd", replaced(binary, "DATA binary", "DATA binary_compressed"));
    EXPECT_THAT(plain.remarks, ElementsAre(HasSubstr("read as binary")));
    // Fields one after the other, with both sizes.
    const PointTable whole = read("a.pcd", packed).table;
    test::Packed columns;
    columns.add(std::uint32_t{12 * 22}).add(std::uint32_t{12 * 22});
    for (const char* const name : {"x", "y", "z"}) {
        for (const double number : column(whole, name)) columns.add(static_cast<float>(number));
    }
    columns.text += std::string(12 * 4, '\7');
    for (const double ring : column(whole, "ring")) columns.add(static_cast<std::uint16_t>(ring));
    for (const double time : column(whole, "t")) columns.add(static_cast<std::uint32_t>(time));
    const CloudFile by_field =
        read("a.pcd", test::pcdHeader(12, "binary_compressed") + columns.text);
    EXPECT_THAT(by_field.remarks, ElementsAre("its points are stored uncompressed"));
    for (const CloudFile* const cloud : {&plain, &by_field}) {
        for (const char* const name : {"x", "z", "ring", "t"}) {
            EXPECT_EQ(column(cloud->table, name), column(whole, name));
        }
    }
    EXPECT_THAT(complaint("a.pcd", replaced(binary, "DATA binary", "DATA binary_compressed") + "x"),
                HasSubstr("or uncompressed (DATA binary)?"));
}

// PLY

TEST_F(CloudFileTest, PlyReportsIgnoredElements) {
    const std::string text = replaced(test::asciiPly({{1, 2, 3, 4, 5}}), "property uint t\n",
                                      "property list int float more\nproperty uint t\n");
    const CloudFile cloud = read("a.ply", replaced(text, " 4 5\n", " 4 2 7.5 8.5 5\n"));
    EXPECT_EQ(namesOf(cloud.table), "x, y, z, ring, t");
    EXPECT_THAT(column(cloud.table, "t"), ElementsAre(5));
    EXPECT_THAT(cloud.remarks,
                ElementsAre(HasSubstr("'camera'"), HasSubstr("more"), HasSubstr("'face'")));
}

TEST_F(CloudFileTest, PlyReadsAllLineEnds) {
    const std::vector<FilePoint> points = filePoints();
    for (const std::string& text : {test::asciiPly(points), test::binaryPly(points, false)}) {
        const std::size_t header = text.find("end_header\n") + 11;
        for (const std::string end : {"\n", "\r\n", "\r", " \n"}) {
            std::string changed;
            for (std::size_t i = 0; i < text.size(); ++i) {
                const bool is_end = text[i] == '\n' && (i < header || text.find("ascii") < header);
                changed += is_end ? end : text.substr(i, 1);
            }
            const PointTable table = read("a.ply", changed).table;
            ASSERT_EQ(table.points, points.size());
            EXPECT_EQ(column(table, "t")[11], points[11].t_ns);
        }
    }
    const std::string binary = "ply\nformat binary_little_endian 1.0\n\x01\xfe\xff\x80\x7f\n";
    EXPECT_THAT(complaint("a.ply", binary), HasSubstr("line 3: binary data is not a line of"));
    EXPECT_THAT(complaint("a.ply", "ply\nelement vertex 1\nproperty float \x81\x82\n"),
                HasSubstr("line 3: is not a valid PLY property"));
}

TEST_F(CloudFileTest, PlySkipsBinaryLists) {
    test::Packed packed;
    packed.addBig(1.0f).addBig(std::uint16_t{2}).addBig(7.0).addBig(8.0).addBig(2.0f).addBig(3.0f);
    const std::string header =
        "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\n"
        "property list ushort double more\nproperty float y\nproperty float z\nend_header\n";
    const CloudFile cloud = read("a.ply", header + packed.text);
    EXPECT_THAT(column(cloud.table, "x"), ElementsAre(1));
    EXPECT_THAT(column(cloud.table, "z"), ElementsAre(3));
    packed.text[4] = '\x7f';  // a list of 32514
    EXPECT_THAT(complaint("a.ply", header + packed.text), HasSubstr("but 0 are present"));
}

TEST_F(CloudFileTest, PlyErrorsIncludeLine) {
    const std::string text = test::asciiPly(filePoints());
    const auto complaintOn = [&](const std::string& what, const std::string& with) {
        return complaint("a.ply", replaced(text, what, with));
    };
    EXPECT_THAT(complaintOn("format ascii", "format zip"),
                AllOf(HasSubstr("line 2"), HasSubstr("zip")));
    EXPECT_THAT(complaintOn("format ascii 1.0\n", ""), HasSubstr("no format"));
    EXPECT_THAT(complaintOn("property float x", "property half x"),
                HasSubstr("line 7: 'half' is not a PLY type"));
    EXPECT_THAT(complaintOn("list uchar float", "list float float"),
                HasSubstr("line 5: the length of a list"));
    EXPECT_THAT(complaintOn("element vertex", "element points"), HasSubstr("no 'vertex'"));
    EXPECT_THAT(complaintOn("element camera", "elements camera"), HasSubstr("line 4: 'elements'"));
    EXPECT_THAT(complaintOn(" 70000\n", "\n"), HasSubstr("line 17: the number of values (4)"));
    EXPECT_THAT(complaintOn(" 70000\n", " 1 2\n"), HasSubstr("line 17: the number of values (6)"));
    EXPECT_THAT(complaintOn(" 70000\n", " -1\n"), HasSubstr("'-1' is not a valid uint32"));
    EXPECT_THAT(complaintOn("2 1 2\n", "99 1 2\n"), HasSubstr("line 15"));
}

// LAS

TEST_F(CloudFileTest, LasReadsPointFormatFields) {
    const PointTable old = read("a.las", test::las(filePoints(1))).table;
    EXPECT_THAT(column(old, "return_number"), ElementsAre(2));
    EXPECT_THAT(column(old, "number_of_returns"), ElementsAre(3));
    EXPECT_THAT(column(old, "classification"), ElementsAre(2));
    EXPECT_THAT(column(old, "scan_angle"), ElementsAre(-3));
    EXPECT_THAT(column(old, "user_data"), ElementsAre(7));
    EXPECT_THAT(column(old, "point_source_id"), ElementsAre(9));

    const CloudFile modern = read("a.las", test::las(filePoints(1), true));
    EXPECT_THAT(column(modern.table, "return_number"), ElementsAre(2));
    EXPECT_THAT(column(modern.table, "number_of_returns"), ElementsAre(3));
    EXPECT_THAT(column(modern.table, "scanner_channel"), ElementsAre(1));
    EXPECT_THAT(column(modern.table, "classification"), ElementsAre(40));
    EXPECT_THAT(column(modern.table, "scan_angle"), ElementsAre(testing::DoubleNear(-3, 1e-5)));
    EXPECT_THAT(column(modern.table, "point_source_id"), ElementsAre(9));
    EXPECT_THAT(modern.remarks, ElementsAre(HasSubstr("4 extra bytes")));
}

TEST_F(CloudFileTest, LasReadsFlags) {
    const std::size_t old_point = 227 + 3, new_point = 375 + 3;
    std::string text = test::las(filePoints(2));  // the class byte is 0xe2: all three flags
    text[old_point + 14] = '\x5a';                // with the scan direction
    text[old_point + 28 + 14] = '\x9a';           // with the edge of the flight line
    text[old_point + 28 + 15] = '\x82';           // withheld
    const PointTable old = read("a.las", text).table;
    EXPECT_THAT(column(old, "classification_flags"), ElementsAre(7, 4));
    EXPECT_THAT(column(old, "scan_direction"), ElementsAre(1, 0));
    EXPECT_THAT(column(old, "edge_of_flight_line"), ElementsAre(0, 1));
    EXPECT_THAT(column(old, "return_number"), ElementsAre(2, 2));
    EXPECT_THAT(column(old, "classification"), ElementsAre(2, 2));

    text = test::las(filePoints(2), true);
    text[new_point + 15] = '\x58';       // overlap, channel 1, scan direction
    text[new_point + 34 + 15] = '\x91';  // synthetic, channel 1, edge of the flight line
    const PointTable modern = read("a.las", text).table;
    EXPECT_THAT(column(modern, "classification_flags"), ElementsAre(8, 1));
    EXPECT_THAT(column(modern, "scan_direction"), ElementsAre(1, 0));
    EXPECT_THAT(column(modern, "edge_of_flight_line"), ElementsAre(0, 1));
    EXPECT_THAT(column(modern, "scanner_channel"), ElementsAre(1, 1));
}

TEST_F(CloudFileTest, LasReportsIgnoredRecords) {
    std::string text = test::las(filePoints(), true);
    text[100] = 2;
    text[243] = 3;
    EXPECT_THAT(
        read("a.las", text + std::string(80, 'r')).remarks,
        ElementsAre(HasSubstr("its variable length records (5)"), HasSubstr("4 extra bytes")));
    EXPECT_THAT(read("a.las", test::las(filePoints()) + "more").remarks,
                ElementsAre(HasSubstr("4 bytes after its last point")));
}

TEST_F(CloudFileTest, LasWithoutPointsHasFields) {
    const PointTable table = read("a.las", test::las({})).table;
    EXPECT_EQ(table.points, 0u);
    EXPECT_THAT(namesOf(table), HasSubstr("gps_time"));
}

TEST_F(CloudFileTest, LasReadsColours) {
    std::string text = test::las(filePoints(1));
    text[104] = 3;
    text[105] = 34;
    const PointTable table = read("a.las", text + std::string("\1\0\2\0\3\0", 6)).table;
    EXPECT_THAT(column(table, "red"), ElementsAre(1));
    EXPECT_THAT(column(table, "blue"), ElementsAre(3));
}

TEST_F(CloudFileTest, LasChecksHeader) {
    const auto with = [&](std::size_t at, const std::string& bytes) {
        std::string text = test::las(filePoints());
        return complaint("a.las", text.replace(at, bytes.size(), bytes));
    };
    EXPECT_THAT(with(104, "\x81"), HasSubstr("LAZ"));
    EXPECT_THAT(with(104, "\x0b"), HasSubstr("byte 104: point format 11"));
    EXPECT_THAT(with(25, "\5"), HasSubstr("LAS 1.5"));
    EXPECT_THAT(with(105, std::string("\x1b\0", 2)), HasSubstr("27 bytes are too short"));
    EXPECT_THAT(with(96, "\xff\xff\xff\xff"), HasSubstr("is it truncated"));
    EXPECT_THAT(with(94, std::string("\1\0", 2)), HasSubstr("a header of 1 bytes"));
    EXPECT_THAT(with(131, std::string(8, '\0')), HasSubstr("scale or offset"));
    EXPECT_THAT(with(155, std::string(8, '\xff')), HasSubstr("scale or offset"));
}

// NPY

TEST_F(CloudFileTest, NpyNamesColumnsByIndex) {
    const std::string numbers = test::Packed().add(1.0).add(2.0).add(3.0).add(4.0).add(5.0).text +
                                test::Packed().add(6.0).add(7.0).add(8.0).add(9.0).add(10.0).text;
    const auto header = [](const char* order, const char* shape) {
        return std::string("{'descr': '<f8', 'fortran_order': ") + order + ", 'shape': " + shape +
               ", }";
    };
    const PointTable rows = read("a.npy", test::npy(header("False", "(2, 5)"), numbers)).table;
    EXPECT_EQ(namesOf(rows), "x, y, z, intensity, field_4");
    EXPECT_THAT(column(rows, "y"), ElementsAre(2, 7));
    EXPECT_THAT(column(rows, "field_4"), ElementsAre(5, 10));
    const PointTable columns = read("a.npy", test::npy(header("True", "(2, 5)"), numbers)).table;
    EXPECT_THAT(column(columns, "y"), ElementsAre(3, 4));
    EXPECT_THAT(column(columns, "field_4"), ElementsAre(9, 10));
    const PointTable image = read("a.npy", test::npy(header("False", "(1, 2, 5)"), numbers)).table;
    EXPECT_THAT(column(image, "z"), ElementsAre(3, 8));
}

TEST_F(CloudFileTest, NpyReadsChannelsFirst) {
    const auto arrayOf = [](const std::string& shape, int rows, int columns, bool is_by_column) {
        test::Packed packed;  // each number is 1000 times its row plus its column
        for (int i = 0; i < rows * columns; ++i) {
            const int row = is_by_column ? i % rows : i / columns;
            const int column = is_by_column ? i / rows : i % columns;
            packed.add(static_cast<float>(1000 * row + column));
        }
        return test::npy(
            "{'descr': '<f4', 'fortran_order': " + std::string(is_by_column ? "True" : "False") +
                ", 'shape': " + shape + ", }",
            packed.text);
    };
    for (const auto& [shape, is_by_column] :
         std::vector<std::pair<std::string, bool>>{{"(4, 80)", false},
                                                   {"(4, 80)", true},
                                                   {"(4, 2, 40)", false},
                                                   {"(1, 4, 2, 40)", false},
                                                   {"(3, 80)", false}}) {
        SCOPED_TRACE(shape);
        const int rows = shape == "(3, 80)" ? 3 : 4;
        const CloudFile cloud = read("a.npy", arrayOf(shape, rows, 80, is_by_column));
        EXPECT_EQ(namesOf(cloud.table), rows == 3 ? "x, y, z" : "x, y, z, intensity");
        ASSERT_EQ(cloud.table.points, 80u);
        EXPECT_EQ(column(cloud.table, "x")[79], 79);
        EXPECT_EQ(column(cloud.table, "z")[7], 2007);
        EXPECT_THAT(cloud.remarks, ElementsAre(HasSubstr("read as 80 points of")));
    }
    EXPECT_EQ(read("a.npy", arrayOf("(4, 8)", 4, 8, false)).table.points, 4u);
    for (const std::string shape : {"(4, 12)", "(400, 160)", "(5, 100, 160)"}) {
        EXPECT_THAT(complaint("a.npy", arrayOf(shape, 400, 200, false)),
                    HasSubstr("array.T or numpy.moveaxis(array, 0, -1)"));
    }
}

TEST_F(CloudFileTest, NpyChecksHeader) {
    const auto complaintOn = [&](const std::string& header) {
        return complaint("a.npy", test::npy(header, std::string(240, '\0')));
    };
    const std::string rest = ", 'fortran_order': False, 'shape': (5, 3), }";
    EXPECT_THAT(complaintOn("{'descr': '<f2'" + rest), HasSubstr("'<f2'"));
    EXPECT_THAT(complaintOn("{'descr': '|O'" + rest), HasSubstr("'|O'"));
    EXPECT_THAT(complaintOn("{'descr': '<f4'" + replaced(rest, "(5, 3)", "(15,)")),
                HasSubstr("at least two dimensions"));
    EXPECT_THAT(complaintOn("{'descr': '<f4'" + replaced(rest, "5, 3", "5, 2")),
                HasSubstr("3 to 32 columns (x, y, z, ...), not 2"));
    EXPECT_THAT(
        complaintOn("{'descr': '<f4'" + replaced(rest, "5, 3", "9999999999, 9999999999, 3")),
        HasSubstr("too large"));
    EXPECT_THAT(complaintOn("{'descr': [('x', '<f4'), ('y', '>f4')]" + rest),
                HasSubstr("mixes little-endian and big-endian numbers"));
    EXPECT_THAT(complaintOn("{'descr': [('x', '<f4', (9999999999, 9999999999))]" + rest),
                HasSubstr("too large"));
    EXPECT_THAT(complaintOn("{'shape': (5, 3)}"), HasSubstr("'descr'"));
    EXPECT_THAT(complaintOn("{'descr': '<f4"), HasSubstr("not a valid dictionary"));
    EXPECT_THAT(complaintOn("{'descr': " + std::string(60, '(')),
                HasSubstr("not a valid dictionary"));
    EXPECT_THAT(complaintOn("{'descr': __import__('os')" + rest), HasSubstr("header "));
}

TEST_F(CloudFileTest, NpyReportsSkippedFields) {
    test::Packed packed;
    packed.add(1.0f).add(std::uint64_t{7}).add(2.0f).add(5.0f).add(6.0f).add(3.0f);
    const CloudFile cloud =
        read("a.npy", test::npy("{'descr': [('x', '<f4'), ('when', '<M8[ns]'), ('y', '<f4'), "
                                "(('a title', 'n'), '<f4', (2,)), ('z', '<f4')], "
                                "'fortran_order': False, 'shape': (1,), }",
                                packed.text));
    EXPECT_EQ(namesOf(cloud.table), "x, y, n, z");
    EXPECT_THAT(column(cloud.table, "z"), ElementsAre(3));
    EXPECT_THAT(columnOf(cloud.table, cloud.table.fields[2], 1), ElementsAre(6));
    EXPECT_THAT(cloud.remarks, ElementsAre(HasSubstr("when")));
}

// BIN

TEST_F(CloudFileTest, BinAcceptsEmptyRejectsTruncated) {
    EXPECT_EQ(read("a.bin", "").table.points, 0u);
    EXPECT_THAT(complaint("a", ""), HasSubstr("is empty"));
    EXPECT_THAT(complaint("a.bin", std::string(15, '\0')), HasSubstr("15 bytes"));
    EXPECT_THAT(complaint("a.bin", std::string(16, '\xee')),
                HasSubstr("not a point cloud: its first numbers are not points of a LiDAR"));
    EXPECT_THAT(complaint("a.bin", std::string(16, 'x')),
                HasSubstr("it seems to be text: if it has a point per line, convert it"));
    // A picture is not reported as a truncated .bin, whatever its size.
    EXPECT_THAT(complaint("a.bin", "\xff\xd8\xff\xe0" + std::string(13, '\xee')),
                HasSubstr("it seems to be a JPEG picture"));
}

/// The file starts with rows of sky, or has no returns at all.
TEST_F(CloudFileTest, BinAcceptsLeadingZeros) {
    const std::vector<FilePoint> points = filePoints(400);
    for (const int zeros : {300, 1000}) {
        SCOPED_TRACE(zeros);
        const auto without = static_cast<std::size_t>(zeros);
        const PointTable none = read("a.bin", std::string(16 * without, '\0')).table;
        EXPECT_THAT(column(none, "x"), AllOf(SizeIs(without), testing::Each(0)));
        const PointTable four =
            read("a.bin", std::string(16 * without, '\0') + test::bin(points)).table;
        EXPECT_EQ(namesOf(four), "x, y, z, intensity");
        ASSERT_EQ(four.points, without + 400);
        EXPECT_EQ(column(four, "x")[without - 1], 0);
        EXPECT_NEAR(column(four, "x")[without + 7], points[7].x_m, 1e-9);
        const PointTable five =
            read("a.bin", std::string(20 * without, '\0') + test::binWithRings(points)).table;
        EXPECT_EQ(namesOf(five), "x, y, z, intensity, ring");
        ASSERT_EQ(five.points, without + 400);
        EXPECT_EQ(column(five, "ring")[without + 7], points[7].ring);
    }
    EXPECT_THAT(complaint("a.bin", std::string(8000, '\0') + std::string(1600, '\xee')),
                HasSubstr("not a point cloud: its first numbers are not points of a LiDAR"));
    EXPECT_THAT(complaint("a", std::string(8000, '\0')), HasSubstr("not a point cloud"));
}

/// A turn of a sensor with 16 beams, column by column: x, y, z, intensity, beam, time and noise.
std::vector<std::vector<float>> turn(bool is_shuffled) {
    test::Random random(4);
    std::vector<std::vector<float>> points;
    for (int i = 0; i < 8000; ++i) {
        const auto beam = static_cast<float>(i % 16), share = static_cast<float>(i) / 8000;
        const float azimuth = 6.2831853f * share, elevation = (0.5f + beam) / 16 - 0.5f;
        const float range_m = random.real(2, 60);
        points.push_back({range_m * std::cos(azimuth), range_m * std::sin(azimuth),
                          range_m * std::tan(elevation), random.real(0, 1), beam, 0.1f * share,
                          random.real(0, 200), 0});
    }
    for (std::size_t i = points.size() - 1; is_shuffled && i > 0; --i) {
        std::swap(points[i],
                  points[static_cast<std::size_t>(random.whole(0, static_cast<int>(i)))]);
    }
    return points;
}

std::string binOf(const std::vector<std::vector<float>>& points, std::size_t numbers) {
    test::Packed packed;
    for (const auto& point : points) {
        for (std::size_t k = 0; k < numbers; ++k) packed.add(point[k]);
    }
    return packed.text;
}

TEST_F(CloudFileTest, BinRefusesContradictedLayout) {
    const auto points = turn(false);
    const std::vector<std::string> fields{"x,y,z",          "", "", "x,y,z,i,-,-", "x,y,z,i,-,-,-",
                                          "x,y,z,i,-,-,-,-"};
    for (std::size_t numbers = 3; numbers <= 8; ++numbers) {
        const std::string bytes = binOf(points, numbers), &layout = fields[numbers - 3];
        if (layout.empty()) {
            EXPECT_EQ(read("a.bin", bytes).table.fields.size(), numbers);
            continue;
        }
        EXPECT_THAT(
            complaint("a.bin", bytes),
            HasSubstr("do not fit 4 numbers per point, but " + std::to_string(numbers) +
                      "; state their meaning: rawlog-segment --bin-fields " + layout + " "));
        const PointTable table = readCloud(write("a.bin", bytes), binFieldsOf(layout)).table;
        EXPECT_EQ(table.points, points.size());
        EXPECT_EQ(column(table, "z")[7999], points[7999][2]);
    }
    std::vector<std::vector<float>> timed = points;  // five numbers, but no ring
    for (auto& point : timed) point[4] = point[5];
    EXPECT_THAT(complaint("a.bin", binOf(timed, 5)), HasSubstr("--bin-fields x,y,z,i,- "));
    for (auto& point : timed) point[4] *= 1e9f;
    EXPECT_THAT(complaint("a.bin", binOf(timed, 5)), HasSubstr("--bin-fields x,y,z,i,- "));
}

TEST_F(CloudFileTest, BinReadsShuffledPoints) {
    EXPECT_EQ(read("a.bin", binOf(turn(true), 4)).table.points, 8000u);
    EXPECT_EQ(read("a.bin", binOf(turn(true), 5)).table.fields.size(), 5u);
}

TEST_F(CloudFileTest, BinFieldsNameNumbers) {
    EXPECT_THAT(binFieldsOf("x,y,z,i,r,t,-,label"),
                ElementsAre("x", "y", "z", "intensity", "ring", "time", "-", "label"));
    EXPECT_THAT(binFieldsOf("_,z,y,x,-"), ElementsAre("-", "z", "y", "x", "-"));
    for (const char* const wrong : {"", "x,y", "x,y,z,", "x,y,z,x", "x,y,z,i,intensity"}) {
        EXPECT_THROW(binFieldsOf(wrong), std::runtime_error) << wrong;
    }
    test::Packed packed;
    for (const float number : {9.0f, 3.0f, 2.0f, 1.0f, 8.0f, 7.0f}) packed.add(number);
    const PointTable table =
        readCloud(write("a.bin", packed.text), binFieldsOf("-,z,y,x,t,_")).table;
    EXPECT_EQ(observations::namesOf(table), "z, y, x, time");
    EXPECT_EQ(column(table, "x")[0], 1);
    EXPECT_EQ(column(table, "time")[0], 8);
}

TEST_F(CloudFileTest, BinReadsRings) {
    for (const int count : {20, 21, 400}) {  // 20 points have a size that is also a multiple of 16
        SCOPED_TRACE(count);
        const std::vector<FilePoint> points = filePoints(count);
        const PointTable table = read("a.pcd.bin", test::binWithRings(points)).table;
        EXPECT_EQ(namesOf(table), "x, y, z, intensity, ring");
        ASSERT_EQ(table.points, points.size());
        EXPECT_NEAR(column(table, "y")[19], points[19].y_m, 1e-9);
        EXPECT_EQ(column(table, "intensity")[19], 17);
        EXPECT_EQ(column(table, "ring")[19], points[19].ring);
    }
    const std::string cut = test::binWithRings(filePoints(20)).substr(0, 384);
    EXPECT_EQ(cloudFormatOf(write("cut", cut)), std::nullopt);
    EXPECT_THAT(complaint("cut.bin", cut), HasSubstr("not a multiple of 20-byte points"));
}

/// The fifth numbers look like rings at first, but are times; intensities are up to 65535.
TEST_F(CloudFileTest, BinRejectsOtherFifthNumbers) {
    std::string text;
    const auto add = [&](float number) {
        text.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    for (int i = 0; i < 400; ++i) {
        const auto number = static_cast<float>(i);
        for (const float of_point : {0.3f + number, 2.5f, 1.2f, 30000 + number}) add(of_point);
        add(i < 300 ? 0 : 1e-4f * number);
    }
    EXPECT_THAT(complaint("a.bin", text), HasSubstr("--bin-fields x,y,z,i,- "));
}

TEST_F(CloudFileTest, BinDetectsPointsWithoutRings) {
    std::vector<FilePoint> grid;  // whole metres, up to 255
    for (int i = 0; i < 200; ++i) {
        const auto number = static_cast<float>(i);
        grid.push_back({number, std::fmod(number, 7.0f), 1, static_cast<std::uint16_t>(4), 0});
    }
    for (const auto& points : {grid, filePoints(20), filePoints(400)}) {
        const PointTable table = read("a.bin", test::bin(points)).table;
        EXPECT_EQ(namesOf(table), "x, y, z, intensity");
        EXPECT_EQ(table.points, points.size());
    }
}

}  // namespace
}  // namespace hagen::recordings
