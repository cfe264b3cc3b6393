// Network captures: files, fragments, datagram contents. Byte 0 selects the sensor.
#include "sensors/captures/LidarCapture.h"

#include <memory>

#include "fuzz/Target.h"
#include "support/CaptureWriter.h"
#include "support/HesaiPackets.h"
#include "support/LivoxPackets.h"
#include "support/OusterPackets.h"
#include "support/SimpleFirings.h"

namespace hagen::fuzz {
namespace {

void readAll(const std::filesystem::path& file, std::unique_ptr<sensors::SweepReader> reader) {
    sensors::LidarCapture capture(file, std::move(reader));
    mayRefuse([&] {
        while (capture.nextSweep()) {
        }
    });
    require(capture.fractionRead() >= 0 && capture.fractionRead() <= 1, "a fraction");
    capture.remarks();
}

void readCapture(std::string_view input) {
    Parts parts(input);
    const std::size_t kind = parts.below(4);
    const InputFile file(parts.rest(), "input.pcap");
    sensors::isCapture(file.path());
    mayRefuse([&] {
        if (kind == 0) {
            readAll(file.path(), sensors::makeVelodyneSweeps());
        } else if (kind == 1) {
            readAll(file.path(), sensors::makeLivoxSweeps());
        } else if (kind == 3) {
            readAll(file.path(), sensors::makeHesaiSweeps());
        } else {
            const InputFile json(test::ousterJson(), "sensor.json");
            readAll(file.path(), sensors::makeOusterSweeps(json.path()));
        }
    });
}

Seeds captureSeeds() {
    auto scan = test::poleScanFrom(0, "velodyne");
    scan->scan_packets.resize(2);
    const test::SentDatagram velodyne{test::bytesOf(scan->scan_packets[0])};
    const std::string two = test::CaptureWriter().packets(*scan, 1700000000).bytes();
    test::CaptureWriter fragments;
    for (const auto& part : test::fragmentsOf(velodyne, 800)) {
        fragments.frame(test::ethernet(part, 1));
    }
    test::CaptureWriter cooked(113);
    cooked.frame(std::string(14, '\0') + std::string("\x08\x00", 2) + test::ipOf(velodyne));
    test::CaptureWriter raw(101);
    raw.frame(test::ipOf(velodyne));
    const auto sensor = sensors::ousterSensorOf(test::ousterJson(), "metadata");
    test::CaptureWriter ouster;
    ouster.datagrams(test::packetsOf(sensor, test::randomFrame(sensor, 3)), 0, 7502);
    test::SentDatagram livox;
    livox.content = std::string(36, '\0') + std::string(140, '\x11');
    livox.content[1] = static_cast<char>(176);
    livox.content[5] = 10;
    livox.content[10] = 1;
    livox.to_port = 56301;
    test::CaptureWriter hesai;
    hesai.datagrams(test::hesaiPackets(16, 2, 3), 2e-4);
    const std::vector<std::string> packets{test::livoxPacketOfWall(0, 5),
                                           test::livoxPacketOfWall(1, 480005)};
    return {'\1' + test::lvx2Of(packets),
            '\0' + two,
            '\3' + hesai.bytes(),
            '\0' + fragments.bytes(),
            '\0' + cooked.bytes(),
            '\0' + raw.bytes(),
            '\0' + test::pcapngOf({test::ethernet(test::ipOf(velodyne))}),
            '\1' + test::CaptureWriter().datagram(livox).bytes(),
            '\2' + ouster.bytes()};
}

const bool kAdded = add({"captures",
                         readCapture,
                         captureSeeds,
                         {"\xd4\xc3\xb2\xa1", "\x4d\x3c\xb2\xa1", "\x0a\x0d\x0d\x0a",
                          "\x4d\x3c\x2b\x1a", std::string("\x08\x00\x45\x00", 4), "\x81\x00"},
                         8000});

}  // namespace
}  // namespace hagen::fuzz
