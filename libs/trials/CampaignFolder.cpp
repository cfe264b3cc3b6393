#include <fcntl.h>
#include <hagen/base/OutputPath.h>
#include <hagen/base/Quantile.h>
#include <hagen/base/WriteFile.h>
#include <hagen/observations/Settings.h>
#include <hagen/trials/CampaignFolder.h>
#include <hagen/trials/Statistics.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

namespace hagen::trials {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

const char kKeyColumns[] =
    "scenario,seed,model,guidance,speed,planner,pose_error,latency_scale,unknown";

std::string shortText(double value, int decimals = -1) {
    if (std::isnan(value)) return "";
    std::array<char, 64> text;
    char* const end = text.data() + text.size();
    const auto written =
        decimals < 0 ? std::to_chars(text.data(), end, value)
                     : std::to_chars(text.data(), end, value, std::chars_format::fixed, decimals);
    return {text.data(), written.ptr};
}

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits), in hexadecimal.
std::string hashOf(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
    return digits.data();
}

ordered_json vehicleJson() {
    const avoidance::VehicleLimits limits;
    return {{"acceleration_m_s2", limits.acceleration_m_s2},
            {"actuation_delay_s", limits.actuation_delay_s},
            {"radius_m", limits.radius_m},
            {"margin_m", limits.margin_m},
            {"collision_m", limits.collision_m},
            {"response_per_s", limits.response_per_s}};
}

/// To be counted up with every change of courses, world models, guidance, planners or the flight
/// itself that makes a run come out otherwise: runs of both must not stand in one table.
constexpr int kRevision = 3;

/// Hash of all that makes a run what it is, but for what its own row tells.
std::string hashOfSettings(const LatencyProfile& profile) {
    return hashOf(std::string(HAGEN_VERSION) + "\n" + std::to_string(kRevision) + "\n" +
                  vehicleJson().dump() + "\n" +
                  observations::dumpSettings(observations::Settings{}) + "\n" + textOf(profile));
}

ordered_json jsonOf(const CampaignPlan& plan) {
    std::vector<std::string> errors;
    for (const PoseError error : plan.pose_errors) errors.push_back(nameOf(error));
    return {{"scenarios", plan.scenarios},
            {"seeds", {plan.first_seed, plan.last_seed}},
            {"speeds_m_s", plan.speeds_m_s},
            {"models", plan.models},
            {"guidances", plan.guidances},
            {"planners", plan.planners},
            {"pose_errors", errors},
            {"latency_scales", plan.latency_scales},
            {"unknown", plan.brakes_in_known_space ? "brake_known" : "optimistic"}};
}

CampaignPlan planFrom(const ordered_json& noted) {
    CampaignPlan plan;
    plan.scenarios = noted.at("scenarios").get<std::vector<std::string>>();
    plan.first_seed = noted.at("seeds").at(0).get<std::uint64_t>();
    plan.last_seed = noted.at("seeds").at(1).get<std::uint64_t>();
    plan.speeds_m_s = noted.at("speeds_m_s").get<std::vector<double>>();
    plan.models = noted.at("models").get<std::vector<std::string>>();
    plan.guidances = noted.at("guidances").get<std::vector<std::string>>();
    plan.planners = noted.at("planners").get<std::vector<std::string>>();
    plan.pose_errors.clear();
    for (const auto& error : noted.at("pose_errors")) {
        plan.pose_errors.push_back(poseErrorFrom(error.get<std::string>()));
    }
    plan.latency_scales = noted.at("latency_scales").get<std::vector<double>>();
    plan.brakes_in_known_space = noted.at("unknown") == "brake_known";
    return plan;
}

/// Writes a file under a temporary name, and renames it when it is whole.
void writeWhole(const fs::path& file, const std::string& text) {
    base::OutputPath output(file, base::kFile, true);
    base::writeText(text, output.temporary(), file);
    output.commit();
}

std::vector<std::string> linesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    if (in.bad() || !in.eof()) throw std::runtime_error(file.string() + ": cannot be read");
    return lines;
}

std::string placeOf(const fs::path& file, std::size_t line) {
    return file.string() + ":" + std::to_string(line + 1);
}

[[noreturn]] void failWith(const fs::path& file, const std::string& what) {
    throw std::runtime_error(file.string() + ": " + what + ": " + std::strerror(errno));
}

}  // namespace

std::vector<fs::path> journalsIn(const fs::path& folder) {
    std::vector<fs::path> journals;
    const fs::path place = folder / "journal";
    std::error_code error;  // the campaign may end, and remove them, at any time
    for (const auto& entry : fs::directory_iterator(place, error)) journals.push_back(entry.path());
    if (error && error != std::errc::no_such_file_or_directory) {
        throw std::runtime_error(place.string() + ": cannot be read: " + error.message());
    }
    std::sort(journals.begin(), journals.end());
    return journals;
}

std::vector<JournalLine> readJournal(const fs::path& file) {
    std::vector<JournalLine> whole;
    const std::vector<std::string> lines = linesOf(file);
    for (std::size_t line = 0; line < lines.size(); ++line) {
        const std::size_t tab = lines[line].find('\t');
        if (tab == std::string::npos || lines[line].back() != ';') {
            if (line + 1 == lines.size()) break;  // torn: it is flown again
            throw std::runtime_error(placeOf(file, line) + ": is no line of a journal");
        }
        whole.push_back({lines[line].substr(0, tab),
                         lines[line].substr(tab + 1, lines[line].size() - tab - 2)});
    }
    return whole;
}

std::vector<CampaignPlan> readPlans(const fs::path& folder) {
    const fs::path file = folder / "campaign.json";
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
    std::vector<CampaignPlan> plans;
    try {
        const ordered_json root = ordered_json::parse(in);
        for (const auto& noted : root.at("flown")) plans.push_back(planFrom(noted));
    } catch (const std::exception& e) {
        throw std::runtime_error(file.string() + ": " + e.what());
    }
    return plans;
}

std::string keyOf(const Run& run) {
    const TrialSetup& setup = run.setup;
    return run.scenario + "," + std::to_string(run.seed) + "," + setup.model + "," +
           setup.guidance + "," + shortText(setup.speed_m_s) + "," + setup.planner + "," +
           nameOf(setup.pose_error) + "," + shortText(setup.latency_scale) + "," +
           (setup.brakes_in_known_space ? "brake_known" : "optimistic");
}

std::string measuredHeader() {
    std::string header = kKeyColumns;
    for (const char* stage : {"filter", "update", "guidance", "planner"}) {
        header += std::string(",") + stage + "_p50_ms," + stage + "_p95_ms";
    }
    return header + ",peak_model_bytes";
}

std::string measuredRowOf(const Run& run, const TrialMeasurement& measurement) {
    const std::string prefix = run.setup.model + "/";
    std::string row = keyOf(run);
    for (const std::string& stage :
         {std::string("filter"), prefix + "update", prefix + run.setup.guidance,
          prefix + run.setup.guidance + "+" + run.setup.planner}) {
        const auto found = measurement.stage_ms.find(stage);
        for (const double share : {0.5, 0.95}) {
            row += ",";
            if (found != measurement.stage_ms.end()) {
                row += shortText(base::quantile(found->second, share), 3);
            }
        }
    }
    return row + "," + shortText(measurement.peak_model_bytes, 0);
}

CampaignFolder::CampaignFolder(fs::path folder, const LatencyProfile& profile, bool overwrite)
    : folder_(std::move(folder)), profile_(profile), settings_hash_(hashOfSettings(profile)) {
    open(overwrite);
}

void CampaignFolder::lock() {
    const int descriptor = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) failWith(folder_, "cannot be opened");
    lock_ = {new int(descriptor), [](const int* held) {
                 ::close(*held);
                 delete held;
             }};
    // A program that was killed may need a moment to be gone with all its workers.
    for (int attempt = 0; flock(descriptor, LOCK_EX | LOCK_NB) != 0; ++attempt) {
        if (attempt == 10) {
            throw std::runtime_error(folder_.string() +
                                     ": another octomap-compare is writing to it");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

void CampaignFolder::open(bool overwrite) {
    fs::create_directories(folder_);
    lock();  // before looking: another program may be making it a campaign's
    const bool is_new = fs::is_empty(folder_);
    const fs::path description = folder_ / "campaign.json";
    if (!is_new && !fs::exists(description)) {
        throw std::runtime_error(folder_.string() +
                                 ": exists, and holds no campaign; name another folder");
    }
    if (overwrite) {
        for (const char* name : {"campaign.json", "profile.json", "runs.csv", "measured.csv"}) {
            fs::remove(folder_ / name);
        }
        fs::remove_all(folder_ / "journal");
    }
    if (is_new || overwrite) {
        writeDescription();
        base::OutputPath profile(folder_ / "profile.json", base::kFile, true);
        writeLatencyProfile(profile_, profile.temporary());
        profile.commit();
        return;
    }
    std::string settings;
    try {
        std::ifstream in(description, std::ios::binary);
        const ordered_json root = ordered_json::parse(in);
        settings = root.at("settings").get<std::string>();
        for (const auto& plan : root.at("flown")) flown_.push_back(plan.dump());
    } catch (const nlohmann::json::exception& e) {
        throw std::runtime_error(description.string() + ": " + e.what());
    }
    if (settings != settings_hash_) {
        throw std::runtime_error(
            folder_.string() +
            ": holds runs of other settings (profile, version, filter or vehicle); name another "
            "folder, give the profile of this one, or --overwrite");
    }
    readTables();
    readJournals();
}

void CampaignFolder::writeDescription() {
    ordered_json root;
    root["program"] = "octomap-compare";
    root["version"] = HAGEN_VERSION;
    root["settings"] = settings_hash_;
    root["profile"] = {
        {"machine", profile_.machine}, {"made_by", profile_.made_by}, {"date", profile_.date}};
    root["vehicle"] = vehicleJson();
    root["filter"] = observations::dumpSettings(observations::Settings{});
    root["flown"] = ordered_json::array();
    for (const std::string& plan : flown_) root["flown"].push_back(ordered_json::parse(plan));
    writeWhole(folder_ / "campaign.json", root.dump(2) + "\n");
}

void CampaignFolder::note(const CampaignPlan& plan) {
    const std::string text = jsonOf(plan).dump();
    if (std::find(flown_.begin(), flown_.end(), text) != flown_.end()) return;
    flown_.push_back(text);
    std::sort(flown_.begin(), flown_.end());
    writeDescription();
}

void CampaignFolder::keep(const std::string& text, const std::string& measured,
                          const std::string& from) {
    const Run run = runOf(text);
    if (run.settings_hash != settings_hash_) throw std::runtime_error("a run of other settings");
    const auto [row, is_new] = rows_.try_emplace(keyOf(run), Row{run, text, measured});
    if (!is_new && row->second.text != text) {
        throw std::runtime_error("contradicts another result of the same run (" + from +
                                 "): " + row->second.text);
    }
}

void CampaignFolder::readTables() {
    const fs::path runs = folder_ / "runs.csv", costs = folder_ / "measured.csv";
    if (!fs::exists(runs)) return;
    std::map<std::string, std::string> measured;
    if (fs::exists(costs)) {
        for (const std::string& line : linesOf(costs)) {
            std::size_t end = 0;  // of the columns that name the run
            for (int column = 0; column < 9 && end != std::string::npos; ++column) {
                end = line.find(',', end + 1);
            }
            measured[line.substr(0, end)] = line;
        }
    }
    for (const Run& run : readRuns(runs)) {
        keep(rowOf(run), measured[keyOf(run)], runs.string());
    }
}

void CampaignFolder::readJournals() {
    for (const fs::path& journal : journalsIn(folder_)) {
        const std::string name = journal.stem().string();
        int number = 0;
        std::from_chars(name.data(), name.data() + name.size(), number);
        next_journal_ = std::max(next_journal_, number + 1);
        const std::vector<JournalLine> lines = readJournal(journal);
        for (std::size_t line = 0; line < lines.size(); ++line) {
            try {
                keep(lines[line].run, lines[line].measured, journal.string());
            } catch (const std::runtime_error& e) {
                throw std::runtime_error(placeOf(journal, line) + ": " + e.what());
            }
        }
    }
}

void CampaignFolder::add(const CampaignFolder& other) {
    if (other.settings_hash_ != settings_hash_) {
        throw std::runtime_error(other.folder_.string() + ": has other settings than " +
                                 folder_.string() + "; only parts of one campaign can be joined");
    }
    for (const auto& [key, row] : other.rows_) {
        try {
            keep(row.text, row.measured, other.folder_.string());
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(other.folder_.string() + ": " + e.what());
        }
    }
    for (const std::string& plan : other.flown_) {
        if (std::find(flown_.begin(), flown_.end(), plan) == flown_.end()) flown_.push_back(plan);
    }
    std::sort(flown_.begin(), flown_.end());
    writeDescription();
}

fs::path CampaignFolder::newJournal() {
    fs::create_directories(folder_ / "journal");
    return folder_ / "journal" / (std::to_string(next_journal_++) + ".csv");
}

std::vector<Run> CampaignFolder::runs() const {
    std::vector<Run> all;
    for (const auto& [key, row] : rows_) all.push_back(row.run);
    sortRuns(all);
    return all;
}

void CampaignFolder::finish() {
    std::string table = runHeader() + "\n", measured = measuredHeader() + "\n";
    for (const Run& run : runs()) {
        const Row& row = rows_.at(keyOf(run));
        table += row.text + "\n";
        if (!row.measured.empty()) measured += row.measured + "\n";
    }
    writeWhole(folder_ / "measured.csv", measured);
    writeWhole(folder_ / "runs.csv", table);
    fs::remove_all(folder_ / "journal");
}

Journal::Journal(fs::path file)
    : file_(std::move(file)),
      descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) failWith(file_, "cannot be written");
}

Journal::~Journal() { ::close(descriptor_); }

void Journal::append(const Run& run, const TrialMeasurement& measurement) {
    const std::string line = rowOf(run) + "\t" + measuredRowOf(run, measurement) + ";\n";
    for (std::size_t done = 0; done < line.size();) {
        const ssize_t wrote = ::write(descriptor_, line.data() + done, line.size() - done);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) failWith(file_, "cannot be written");
        done += static_cast<std::size_t>(wrote);
    }
    // Where a device cannot, there is nothing to wait for.
    if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) {
        failWith(file_, "cannot be written");
    }
}

std::size_t mergeCampaigns(const std::vector<fs::path>& folders, const fs::path& into,
                           bool overwrite) {
    if (folders.empty()) throw std::invalid_argument("no folder to merge is given");
    for (const fs::path& folder : folders) {
        if (!fs::exists(folder / "campaign.json")) {
            throw std::runtime_error(folder.string() + ": holds no campaign (campaign.json)");
        }
        if (fs::exists(into) && fs::equivalent(folder, into)) {
            throw std::runtime_error(folder.string() + ": is the output, too");
        }
    }
    const auto profileOf = [](const fs::path& folder) {
        return readLatencyProfile(folder / "profile.json");
    };
    CampaignFolder merged(into, profileOf(folders.front()), overwrite);
    for (const fs::path& folder : folders) {
        merged.add(CampaignFolder(folder, profileOf(folder), false));
    }
    merged.finish();
    return merged.size();
}

}  // namespace hagen::trials
