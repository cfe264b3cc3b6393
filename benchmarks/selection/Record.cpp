#include "Record.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include "base/Json.h"

namespace hagen::selection {
namespace {

using base::Json;

Json json(const evaluation::ClassScore& score) {
    return Json::array({score.hits, score.misses, score.false_alarms});
}
Json json(const Counts& counts) {
    return {{"roi", json(counts.scores.roi)},
            {"rou", json(counts.scores.rou)},
            {"missed", Json::array({counts.missed.missed, counts.missed.all})}};
}
Json json(const MissedByGroup& missed) {
    Json by_group = Json::object();
    for (std::size_t group = 0; group < kGroups; ++group)
        by_group[nameOf(static_cast<Group>(group))] = missed[group];
    return by_group;
}

Json json(const std::vector<Counts>& counts) {
    Json items = Json::array();
    for (const Counts& one : counts) items.push_back(json(one));
    return items;
}
Json json(const Fold& fold) {
    return {{"left_out", fold.left_out},
            {"chosen", fold.chosen},
            {"start", fold.start},
            {"objective", fold.objective},
            {"missed_start", json(fold.missed_start)},
            {"missed", json(fold.missed)},
            {"limit", json(fold.limit)},
            {"rounds", fold.rounds}};
}

evaluation::ClassScore classScoreOf(const nlohmann::json& json) {
    return {json.at(0), json.at(1), json.at(2)};
}
Counts countsOf(const nlohmann::json& json) {
    const nlohmann::json& missed = json.at("missed");
    return {{classScoreOf(json.at("roi")), classScoreOf(json.at("rou"))},
            {missed.at(0), missed.at(1)}};
}
MissedByGroup missedOf(const nlohmann::json& json) {
    MissedByGroup missed{};
    for (std::size_t group = 0; group < kGroups; ++group)
        missed[group] = json.at(nameOf(static_cast<Group>(group)));
    return missed;
}

std::vector<Counts> listOfCounts(const nlohmann::json& json) {
    std::vector<Counts> all;
    for (const nlohmann::json& item : json) all.push_back(countsOf(item));
    return all;
}

Fold foldOf(const nlohmann::json& json) {
    return {json.at("left_out"),
            json.at("chosen"),
            json.at("start"),
            json.at("objective"),
            missedOf(json.at("missed_start")),
            missedOf(json.at("missed")),
            missedOf(json.at("limit")),
            json.at("rounds")};
}

Record recordOf(const nlohmann::json& json) {
    Record record;
    json.at("revision").get_to(record.revision);
    json.at("seeds").get_to(record.seeds);
    json.at("hard_sets").get_to(record.hard_sets);
    json.at("scans").get_to(record.scans);
    json.at("measured").get_to(record.measured);
    for (const nlohmann::json& item : json.at("settings")) {
        record.settings.push_back({item.at("key"), item.at("present"), item.at("tried")});
    }
    for (const nlohmann::json& item : json.at("searches")) {
        Search search{item.at("start"), {}};
        for (const nlohmann::json& fold : item.at("folds")) search.folds.push_back(foldOf(fold));
        record.searches.push_back(search);
    }
    for (const nlohmann::json& item : json.at("scores")) {
        record.scores.push_back({item.at("data"), item.at("drive"), countsOf(item.at("present")),
                                 listOfCounts(item.at("with_all")),
                                 listOfCounts(item.at("left_out"))});
    }
    return record;
}

std::vector<std::string> each(const std::vector<DriveScores>& scores,
                              std::string DriveScores::*name) {
    std::vector<std::string> names;
    for (const DriveScores& s : scores) {
        if (std::find(names.begin(), names.end(), s.*name) == names.end()) names.push_back(s.*name);
    }
    return names;
}

}  // namespace

std::vector<std::string> Record::data() const { return each(scores, &DriveScores::data); }
std::vector<std::string> Record::drives() const {
    std::vector<std::string> names = each(scores, &DriveScores::drive);
    std::sort(names.begin(), names.end());
    return names;
}

const DriveScores* Record::find(const std::string& data_name, const std::string& drive) const {
    const auto found = std::find_if(scores.begin(), scores.end(), [&](const DriveScores& s) {
        return s.data == data_name && s.drive == drive;
    });
    return found == scores.end() ? nullptr : &*found;
}

std::string jsonOf(const Record& record) {
    Json settings = Json::array(), searches = Json::array(), scores = Json::array();
    for (const TriedSetting& s : record.settings)
        settings.push_back({{"key", s.key}, {"present", s.present}, {"tried", s.tried}});
    for (const Search& search : record.searches) {
        Json folds = Json::array();
        for (const Fold& fold : search.folds) folds.push_back(json(fold));
        searches.push_back({{"start", search.start}, {"folds", folds}});
    }
    for (const DriveScores& s : record.scores) {
        scores.push_back({{"data", s.data},
                          {"drive", s.drive},
                          {"present", json(s.present)},
                          {"with_all", json(s.with_all)},
                          {"left_out", json(s.left_out)}});
    }
    const Json all{{"made_by", "scripts/select-settings"},
                   {"revision", record.revision},
                   {"seeds", record.seeds},
                   {"hard_sets", record.hard_sets},
                   {"scans", record.scans},
                   {"measured", record.measured},
                   {"settings", settings},
                   {"searches", searches},
                   {"scores", scores}};
    return all.dump(1) + "\n";
}

Record readRecord(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    try {
        return recordOf(base::parseJson(text));
    } catch (const std::exception& e) {
        throw std::runtime_error(
            file.string() + ": invalid record; run scripts/select-settings again: " + e.what());
    }
}

}  // namespace hagen::selection
