#include "recordings/PoseFile.h"
#include <hagen/mrpt/TimeStamp.h>
#include <mrpt/poses/CPose3DQuat.h>
#include <Eigen/Dense>
#include "base/ReadFile.h"
#include "recordings/NumberTable.h"

#include <cmath>
#include <iomanip>

#include "base/WriteFile.h"

namespace hagen::recordings {
namespace {

namespace fs = std::filesystem;
using mrpt::poses::CPose3D;

const std::string kTumColumns = "time x y z qx qy qz qw";
const std::string kKittiColumns = "a 3x4 matrix, row by row";
constexpr double kRotationTolerance = 1e-3;  // files have six digits or more

[[noreturn]] void failPose(const fs::path& file, const NumberLine& line, const std::string& why) {
    throw std::runtime_error(file.string() + ":" + std::to_string(line.line) + ": " + why);
}

CPose3D poseOfMatrix(const fs::path& file, const NumberLine& line) {
    checkColumns(file, line, 12, kKittiColumns);
    mrpt::math::CMatrixDouble44 matrix = mrpt::math::CMatrixDouble44::Identity();
    for (int i = 0; i < 12; ++i) matrix(i / 4, i % 4) = line.numbers[i];
    const auto rotation = matrix.asEigen().topLeftCorner<3, 3>();
    const double skew = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
    if (!(skew <= kRotationTolerance) || !(rotation.determinant() > 0)) {  // true for NaN
        failPose(file, line, "the matrix is not a rigid transformation");
    }
    return CPose3D(matrix);
}

std::ofstream openForWriting(const fs::path& file, int digits) {
    std::ofstream out(file);
    out << std::fixed << std::setprecision(digits);
    return out;
}

}  // namespace

PoseFileKind kindOfPoseFile(const fs::path& file) {
    const std::vector<NumberLine> table = readNumberTable(file, 1);
    if (table.empty()) throw std::runtime_error(file.string() + ": contains no poses");
    if (table.front().numbers.size() == 12) return PoseFileKind::Kitti;
    checkColumns(file, table.front(), 8,
                 "TUM: " + kTumColumns + "; or 12, KITTI: " + kKittiColumns);
    return PoseFileKind::Tum;
}

std::vector<TimedPose> readTumPoses(const fs::path& file) {
    std::vector<TimedPose> poses;
    for (const NumberLine& line : readNumberTable(file)) {
        checkColumns(file, line, 8, kTumColumns);
        const auto& n = line.numbers;
        if (!observations::isTime(n[0]))
            failPose(file, line, "the first number is not a time in seconds");
        const double norm = std::sqrt(n[4] * n[4] + n[5] * n[5] + n[6] * n[6] + n[7] * n[7]);
        if (std::abs(norm - 1.0) > kRotationTolerance) {
            failPose(file, line, "the quaternion is not normalized");
        }
        const mrpt::math::CQuaternionDouble rotation(n[7] / norm, n[4] / norm, n[5] / norm,
                                                     n[6] / norm);
        poses.push_back({n[0], CPose3D(mrpt::poses::CPose3DQuat(n[1], n[2], n[3], rotation))});
    }
    return poses;
}

void writeTumPoses(const fs::path& file, const std::vector<TimedPose>& poses) {
    std::ofstream out = openForWriting(file, 9);
    out << "# " << kTumColumns << "\n";
    for (const auto& [time_s, pose] : poses) {
        const mrpt::poses::CPose3DQuat p(pose);
        out << time_s;
        for (const double number :
             {p.x(), p.y(), p.z(), p.quat().x(), p.quat().y(), p.quat().z(), p.quat().r()}) {
            out << " " << number;
        }
        out << "\n";
    }
    base::closeWritten(out, file);
}

std::vector<CPose3D> readKittiPoses(const fs::path& file) {
    std::vector<CPose3D> poses;
    for (const NumberLine& line : readNumberTable(file)) poses.push_back(poseOfMatrix(file, line));
    return poses;
}

void writeKittiPoses(const fs::path& file, const std::vector<CPose3D>& sensor_poses) {
    std::ofstream out = openForWriting(file, 9);
    for (const CPose3D& pose : sensor_poses) {
        const auto matrix =
            (pose - sensor_poses.front()).getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
        for (int i = 0; i < 12; ++i) out << (i > 0 ? " " : "") << matrix(i / 4, i % 4);
        out << "\n";
    }
    base::closeWritten(out, file);
}

CPose3D readKittiCalibration(const fs::path& file) {
    std::ifstream in = base::openToRead(file);
    std::size_t number = 0;
    for (std::string text; base::nextLine(in, text, file);) {
        ++number;
        if (text.rfind("Tr:", 0) != 0) continue;
        std::istringstream words(text.substr(3));
        NumberLine line{number, {}};
        for (double value; words >> value;) line.numbers.push_back(value);
        return poseOfMatrix(file, line);
    }
    throw std::runtime_error(file.string() +
                             ": has no line 'Tr:' (LiDAR pose in the camera frame)");
}

}  // namespace hagen::recordings
