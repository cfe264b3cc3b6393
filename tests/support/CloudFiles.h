#pragma once
// Writes point cloud files byte by byte as specified by their formats.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace hagen::test {

/// Appends numbers as consecutive bytes.
class Packed {
 public:
    template <class Number>
    Packed& add(Number number) {
        char bytes[sizeof number];
        std::memcpy(bytes, &number, sizeof number);
        text.append(bytes, sizeof number);
        return *this;
    }
    /// Adds a big-endian number.
    template <class Number>
    Packed& addBig(Number number) {
        const std::size_t start = text.size();
        add(number);
        for (std::size_t i = 0; i < sizeof number / 2; ++i) {
            std::swap(text[start + i], text[text.size() - 1 - i]);
        }
        return *this;
    }
    std::string text;
};

struct FilePoint {
    float x_m, y_m, z_m;
    std::uint16_t ring;
    std::uint32_t t_ns;
};

inline std::vector<FilePoint> filePoints(int count = 12) {
    std::vector<FilePoint> points;
    for (int i = 0; i < count; ++i) {
        const auto number = static_cast<float>(i);
        points.push_back({1.5f + number, -2.25f * number, 0.125f * number,
                          static_cast<std::uint16_t>(i % 4), 70000u * static_cast<unsigned>(i)});
    }
    return points;
}

inline std::string pcdHeader(std::size_t points, const std::string& data) {
    const std::string count = std::to_string(points);
    return "# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS x y z _ ring t\n"
           "SIZE 4 4 4 1 2 4\nTYPE F F F U U U\nCOUNT 1 1 1 4 1 1\nWIDTH " +
           count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + data + "\n";
}

/// A binary PCD with four bytes of padding per point.
inline std::string binaryPcd(const std::vector<FilePoint>& points) {
    Packed packed;
    for (const FilePoint& point : points) {
        packed.add(point.x_m).add(point.y_m).add(point.z_m).add(std::uint32_t{0xdeadbeef});
        packed.add(point.ring).add(point.t_ns);
    }
    return pcdHeader(points.size(), "binary") + packed.text;
}

inline std::string words(const FilePoint& point, const std::string& padding) {
    return std::to_string(point.x_m) + " " + std::to_string(point.y_m) + " " +
           std::to_string(point.z_m) + padding + " " + std::to_string(point.ring) + " " +
           std::to_string(point.t_ns) + "\n";
}

inline std::string asciiPcd(const std::vector<FilePoint>& points) {
    std::string text = pcdHeader(points.size(), "ascii");
    for (const FilePoint& point : points) text += words(point, " 0 0 0 0");
    return text;
}

/// A PCD compressed as literal runs of at most 32 bytes, which is valid LZF.
inline std::string compressedPcd(const std::vector<FilePoint>& points) {
    Packed columns;
    for (const auto& point : points) columns.add(point.x_m);
    for (const auto& point : points) columns.add(point.y_m);
    for (const auto& point : points) columns.add(point.z_m);
    columns.text += std::string(4 * points.size(), '\7');
    for (const auto& point : points) columns.add(point.ring);
    for (const auto& point : points) columns.add(point.t_ns);
    std::string runs;
    for (std::size_t at = 0; at < columns.text.size(); at += 32) {
        const std::string run = columns.text.substr(at, 32);
        runs += static_cast<char>(run.size() - 1) + run;
    }
    Packed sizes;
    sizes.add(static_cast<std::uint32_t>(runs.size()));
    sizes.add(static_cast<std::uint32_t>(columns.text.size()));
    return pcdHeader(points.size(), "binary_compressed") + sizes.text + runs;
}

inline std::string plyHeader(std::size_t points, const std::string& format,
                             const std::string& more = "") {
    return "ply\nformat " + format + " 1.0\ncomment by hand\nelement camera 1\n" +
           "property list uchar float pose\nelement vertex " + std::to_string(points) +
           "\nproperty float x\nproperty float32 y\nproperty float z\nproperty ushort ring\n"
           "property uint t\n" +
           more + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

/// A binary PLY with one list before the vertices and another after them.
inline std::string binaryPly(const std::vector<FilePoint>& points, bool is_big) {
    Packed packed;
    const auto add = [&](auto number) { is_big ? packed.addBig(number) : packed.add(number); };
    add(std::uint8_t{2});
    add(1.0f);
    add(2.0f);
    for (const FilePoint& point : points) {
        add(point.x_m);
        add(point.y_m);
        add(point.z_m);
        add(point.ring);
        add(point.t_ns);
    }
    add(std::uint8_t{1});
    add(std::int32_t{0});
    return plyHeader(points.size(), is_big ? "binary_big_endian" : "binary_little_endian") +
           packed.text;
}

inline std::string asciiPly(const std::vector<FilePoint>& points) {
    std::string text = plyHeader(points.size(), "ascii") + "2 1 2\n";
    for (const FilePoint& point : points) text += words(point, "");
    return text + "1 0\n";
}

/// An array as saved by NumPy; the header is padded to 64 bytes.
inline std::string npy(std::string header, const std::string& data) {
    while ((10 + header.size() + 1) % 64 != 0) header += ' ';
    header += '\n';
    Packed start;
    start.text = "\x93NUMPY";
    start.add(std::uint8_t{1}).add(std::uint8_t{0});
    start.add(static_cast<std::uint16_t>(header.size()));
    return start.text + header + data;
}

inline std::string structuredNpy(const std::vector<FilePoint>& points, bool is_big = false) {
    Packed packed;
    const auto add = [&](auto number) { is_big ? packed.addBig(number) : packed.add(number); };
    for (const FilePoint& point : points) {
        add(point.x_m);
        add(point.y_m);
        add(point.z_m);
        add(point.ring);
        packed.add(std::uint16_t{0xbeef});
        add(point.t_ns);
    }
    const std::string order = is_big ? ">" : "<";
    const auto field = [&](const std::string& name, const std::string& type) {
        return "('" + name + "', '" + order + type + "'), ";
    };
    return npy("{'descr': [" + field("x", "f4") + field("y", "f4") + field("z", "f4") +
                   field("ring", "u2") + "('', '|V2'), " + field("t", "u4") +
                   "], 'fortran_order': False, 'shape': (" + std::to_string(points.size()) +
                   ",), }",
               packed.text);
}

/// LAS 1.2 with point format 1, or 1.4 with point format 6 and four extra bytes per point.
inline std::string las(const std::vector<FilePoint>& points, bool is_new = false) {
    const std::size_t header_size = is_new ? 375 : 227, record = is_new ? 34 : 28;
    std::string header(header_size, '\0');
    const auto put = [&](std::size_t at, auto number) {
        std::memcpy(&header[at], &number, sizeof number);
    };
    header.replace(0, 4, "LASF");
    put(24, std::uint8_t{1});
    put(25, static_cast<std::uint8_t>(is_new ? 4 : 2));
    put(94, static_cast<std::uint16_t>(header_size));
    put(96, static_cast<std::uint32_t>(header_size + 3));  // three other bytes precede the points
    put(104, static_cast<std::uint8_t>(is_new ? 6 : 1));
    put(105, static_cast<std::uint16_t>(record));
    put(107, static_cast<std::uint32_t>(is_new ? 0 : points.size()));
    for (std::size_t axis = 0; axis < 3; ++axis) put(131 + 8 * axis, 0.001);
    put(155, 0.5);
    if (is_new) put(247, static_cast<std::uint64_t>(points.size()));
    Packed packed;
    for (const FilePoint& point : points) {
        packed.add(static_cast<std::int32_t>(point.x_m * 1000 - 500));
        packed.add(static_cast<std::int32_t>(point.y_m * 1000));
        packed.add(static_cast<std::int32_t>(point.z_m * 1000));
        packed.add(static_cast<std::uint16_t>(1000 + point.ring));
        if (is_new) {
            packed.add(std::uint8_t{0x32});  // the second of three returns
            packed.add(std::uint8_t{0x10});  // channel 1
            packed.add(std::uint8_t{40}).add(std::uint8_t{7});
            packed.add(std::int16_t{-500}).add(std::uint16_t{9});
            packed.add(1e-9 * point.t_ns).add(std::uint32_t{0xffffffff});
        } else {
            packed.add(std::uint8_t{0x1a});  // the second of three returns
            packed.add(std::uint8_t{0xe2});  // class 2, with flags
            packed.add(std::int8_t{-3}).add(std::uint8_t{7});
            packed.add(std::uint16_t{9}).add(1e-9 * point.t_ns);
        }
    }
    return header + "abc" + packed.text;
}

inline std::string bin(const std::vector<FilePoint>& points) {
    Packed packed;
    for (const FilePoint& point : points) {
        packed.add(point.x_m).add(point.y_m).add(point.z_m).add(0.25f * point.ring);
    }
    return packed.text;
}

/// A .bin file with rings, like nuScenes.
inline std::string binWithRings(const std::vector<FilePoint>& points) {
    Packed packed;
    for (const FilePoint& point : points) {
        packed.add(point.x_m).add(point.y_m).add(point.z_m).add(17.0f);
        packed.add(static_cast<float>(point.ring));
    }
    return packed.text;
}

/// A named file in each format.
inline std::vector<std::pair<std::string, std::string>> cloudFiles(
    const std::vector<FilePoint>& points = filePoints()) {
    return {{"ascii.pcd", asciiPcd(points)},
            {"binary.pcd", binaryPcd(points)},
            {"packed.pcd", compressedPcd(points)},
            {"ascii.ply", asciiPly(points)},
            {"little.ply", binaryPly(points, false)},
            {"big.ply", binaryPly(points, true)},
            {"old.las", las(points)},
            {"new.las", las(points, true)},
            {"fields.npy", structuredNpy(points)},
            {"big.npy", structuredNpy(points, true)},
            {"points.bin", bin(points)}};
}

inline void writeFile(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

}  // namespace hagen::test
