#include "convert/LearnAirframe.h"
#include <hagen/mrpt/TimeStamp.h>

#include <hagen/mrpt/MrptMessage.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanSource.h>
#include "base/Folder.h"
#include "base/NumberText.h"
#include "base/OutputSet.h"
#include "base/WriteFile.h"
#include "convert/pictures/AirframePicture.h"
#include "scan/AirframeLearner.h"
#include "settings/AirframeFile.h"

#include <new>

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;

/// Adds the scans of the first `seconds` of the recording to the learner.
void addScans(const AirframeLearning& learning, const AirframeListener& listener,
              AirframeLearner& learner, AirframeReport& report) {
    recordings::SourceOptions options = learning.source;
    options.keep_going = listener.keep_going;
    const auto source = openRecording(learning.input, options);
    const Settings settings = source->useSettings(learning.settings);
    observations::ObservedScan observed;
    std::optional<double> first_s;
    while (const auto scan = source->nextScan()) {
        const double time_s = observations::secondsOf(scan->observation->timestamp);
        if (observations::isTime(time_s)) {
            if (!first_s) first_s = time_s;
            if (time_s - *first_s >= learning.seconds) break;
        }
        const std::string& label = scan->observation->sensorLabel;
        if (report.scans + report.unreadable_scans == 0) report.sensor_label = label;
        if (label != report.sensor_label) {
            throw std::runtime_error(learning.input.string() + ": has scans of '" +
                                     report.sensor_label + "' and '" + label +
                                     "', but an airframe belongs to one sensor; select it with "
                                     "--sensor-label");
        }
        try {
            observations::readObservation(*scan->observation, settings, observed, scan->beams);
        } catch (const SettingsError&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& e) {
            ++report.unreadable_scans;
            listener.unreadable(titleOf(*scan), observations::messageOf(e));
            continue;
        }
        learner.add(observed.scan);
        ++report.scans;
    }
    for (const std::string& remark : source->remarks()) listener.remark(remark);
}

}  // namespace

AirframeReport learnAirframe(const AirframeLearning& learning, const AirframeListener& listener) {
    AirframeReport report;
    report.picture = fs::path(learning.file).replace_extension(".png");
    std::vector<fs::path> inputs = learning.settings.files;
    inputs.insert(inputs.end(),
                  {learning.input, learning.source.sensor_json, learning.source.calibration});
    base::checkApart({learning.file, report.picture}, inputs);
    base::OutputPath file(learning.file, base::kFile, learning.overwrite);
    base::OutputPath picture(report.picture, base::kFile, learning.overwrite);

    AirframeLearner learner;
    addScans(learning, listener, learner, report);
    const std::string origin = base::lastNameOf(learning.input) + ", " + report.sensor_label +
                               ", " + base::counted(report.scans, "scan");
    LearnedAirframe learned;
    try {
        learned = learner.learn();
    } catch (const std::invalid_argument& e) {
        throw std::runtime_error(learning.input.string() + ": " + e.what() +
                                 " (read only the first " + base::shortestText(learning.seconds) +
                                 " s; see --learn-seconds)");
    }
    report.bins = learned.bins;
    report.share_of_sphere = learned.share_of_sphere;
    report.share_of_seen = learned.share_of_seen;

    base::OutputSet outputs;
    outputs.add(picture);
    outputs.add(file);
    outputs.write(file, [&] {
        base::writeText(airframeBinsText(learned.bin_range_m, origin), file.temporary(),
                        file.path());
    });
    outputs.write(picture, [&] {
        drawAirframe(learned.bin_range_m, "airframe in " + origin, picture.temporary());
    });
    outputs.commit();
    return report;
}

}  // namespace hagen::convert
