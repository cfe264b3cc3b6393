#include <hagen/sensors/VelodynePacket.h>
#include "sensors/SweepReader.h"
#include "sensors/velodyne/VelodyneCalibrationFile.h"
#include "sensors/velodyne/VelodyneTurns.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>

#include "sensors/SensorTable.h"

namespace hagen::sensors {
namespace {

constexpr std::uint16_t kPositionPort = 8308;

/// Sweep reader of makeVelodyneSweeps().
class VelodyneSweeps : public SweepReader {
 public:
    explicit VelodyneSweeps(const std::filesystem::path& calibration)
        : calibration_file_(calibration) {
        if (!calibration.empty()) calibration_ = readVelodyneCalibration(calibration);
    }

    void preview(const Datagram& datagram) override {
        if (!isVelodyneData(datagram.bytes, datagram.size)) return;
        const VelodyneModel* const model = velodyneModelOf(datagram.bytes);
        AzimuthView* const view = model == nullptr ? nullptr : viewOf(keyOf(datagram, *model));
        if (view != nullptr) view->add(packetOf(datagram));
    }

    void add(const Datagram& datagram) override {
        if (datagram.size == kPositionBytes && datagram.to_port == kPositionPort) {
            ++position_packets_;
            return;
        }
        if (!isVelodyneData(datagram.bytes, datagram.size)) return others_.add(datagram);
        const VelodyneModel* const model = velodyneModelOf(datagram.bytes);
        if (model == nullptr) {
            ++unknown_ids_[datagram.bytes[kVelodyneModelAt]];
            return;
        }
        const bool is_hdl64 = model == &hdl64Model();
        hdl64_packets_ += is_hdl64;
        if (!is_hdl64 || calibration_) add(datagram, *model);
    }

    void finish() override {
        for (auto& entry : sensors_.entries()) {
            entry.sensor.finish();
            collect(entry.sensor);
        }
    }

    std::vector<std::string> remarks() const override {
        std::vector<std::string> remarks;
        for (const auto& [key, label, turns] : sensors_.entries()) {
            remarks.push_back(label + " (" + turns.model().name + " at " +
                              ipText(std::get<0>(key)) + ", port " +
                              std::to_string(std::get<1>(key)) + "): " + textOf(turns.counts()));
        }
        if (calibration_ && hdl64_packets_ == 0) {
            remarks.push_back(calibration_file_.string() +
                              " is not used: there are no HDL-64E packets");
        }
        return remarks;
    }

    std::string ignored() const override {
        std::string text;
        addCount(position_packets_, "position packet", "(GPS)", text);
        return joined(text, unknown());
    }

    std::string whyEmpty(const std::string& losses) const override {
        if (packets_ > 0) return "";
        std::string found = joined(unknown(), losses);
        addCount(position_packets_, "position packet", "", found);
        return "has no data packets from a known Velodyne (" + knownVelodynes().substr(1) +
               "); it has " + (found.empty() ? "no frames" : found) +
               (others_.haveVendor()
                    ? ""
                    : ". For Ouster packets, pass the metadata with --sensor-json FILE");
    }

 private:
    using Key = std::tuple<IpAddress, std::uint16_t, std::uint8_t>;

    static Key keyOf(const Datagram& datagram, const VelodyneModel& model) {
        return {datagram.from_ip, datagram.to_port, model.id};
    }

    SilentSector silenceOf(const Key& key) {
        const AzimuthView* const view = viewOf(key);
        return view == nullptr ? SilentSector() : view->silence().value_or(SilentSector());
    }

    /// Null if there are too many sensors.
    AzimuthView* viewOf(const Key& key) {
        return views_.find(key, [](const std::string&) { return AzimuthView(); });
    }

    static VelodynePacket packetOf(const Datagram& datagram) {
        VelodynePacket packet;
        std::copy_n(datagram.bytes, packet.bytes.size(), packet.bytes.begin());
        packet.time_ns = datagram.time_ns;
        return packet;
    }

    void add(const Datagram& datagram, const VelodyneModel& model) {
        const Key key = keyOf(datagram, model);
        VelodyneTurns* const turns = sensors_.find(key, [&](const std::string& label) {
            return VelodyneTurns(model, label, &model == &hdl64Model() ? &*calibration_ : nullptr,
                                 silenceOf(key));
        });
        if (turns == nullptr) return;
        ++packets_;
        turns->add(packetOf(datagram));
        collect(*turns);
    }

    void collect(VelodyneTurns& turns) {
        std::move(turns.complete().begin(), turns.complete().end(), std::back_inserter(complete_));
        turns.complete().clear();
    }

    /// Counts of datagrams that are not from a known Velodyne model.
    std::string unknown() const {
        std::string text;
        if (!calibration_) {
            addCount(hdl64_packets_, "packet",
                     "from an HDL-64E (unreadable without --calibration FILE)", text);
        }
        for (const auto& [id, count] : unknown_ids_) {
            addCount(count, "packet", "from " + describeUnsupported(id), text);
        }
        addCount(sensors_.further(), "packet", "from further sensors", text);
        others_.describe(text);
        return text;
    }

    std::filesystem::path calibration_file_;
    std::optional<VelodyneCalibration> calibration_;
    SensorTable<Key, AzimuthView> views_{"velodyne"};
    SensorTable<Key, VelodyneTurns> sensors_{"velodyne"};
    std::size_t packets_ = 0, position_packets_ = 0, hdl64_packets_ = 0;
    std::map<unsigned, std::size_t> unknown_ids_;
};

}  // namespace

std::unique_ptr<SweepReader> makeVelodyneSweeps(const std::filesystem::path& calibration) {
    return std::make_unique<VelodyneSweeps>(calibration);
}

}  // namespace hagen::sensors
