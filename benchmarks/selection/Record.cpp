#include "Record.h"

#include <hagen/base/Json.h>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace hagen::selection {
namespace {

using base::Json;

template <class Value>
Json list(const std::vector<Value>& values) {
    Json items = Json::array();
    for (const Value& value : values) items.push_back(Json(value));
    return items;
}

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
            {"chosen", list(fold.chosen)},
            {"start", fold.start},
            {"objective", fold.objective},
            {"missed_start", json(fold.missed_start)},
            {"missed", json(fold.missed)},
            {"limit", json(fold.limit)},
            {"rounds", fold.rounds}};
}

std::int64_t whole(const Json& json) { return static_cast<std::int64_t>(json.count()); }

evaluation::ClassScore classScoreOf(const Json& json) {
    return {whole(json.at(std::size_t{0})), whole(json.at(1)), whole(json.at(2))};
}
Counts countsOf(const Json& json) {
    const Json& missed = json.at("missed");
    return {{classScoreOf(json.at("roi")), classScoreOf(json.at("rou"))},
            {whole(missed.at(std::size_t{0})), whole(missed.at(1))}};
}
MissedByGroup missedOf(const Json& json) {
    MissedByGroup missed{};
    for (std::size_t group = 0; group < kGroups; ++group)
        missed[group] = whole(json.at(nameOf(static_cast<Group>(group))));
    return missed;
}

std::vector<Counts> listOfCounts(const Json& json) {
    std::vector<Counts> all;
    for (const Json& item : json.items()) all.push_back(countsOf(item));
    return all;
}

Fold foldOf(const Json& json) {
    return {json.at("left_out").text(),        json.at("chosen").texts(),
            json.at("start").number(),         json.at("objective").number(),
            missedOf(json.at("missed_start")), missedOf(json.at("missed")),
            missedOf(json.at("limit")),        static_cast<int>(json.at("rounds").count())};
}

Record recordOf(const Json& json) {
    Record record;
    record.revision = json.at("revision").text();
    for (const Json& seed : json.at("seeds").items()) record.seeds.push_back(seed.count());
    record.hard_sets = json.at("hard_sets").texts();
    record.scans = json.at("scans").count();
    record.measured = json.at("measured").count();
    for (const Json& item : json.at("settings").items()) {
        record.settings.push_back(
            {item.at("key").text(), item.at("present").text(), item.at("tried").texts()});
    }
    for (const Json& item : json.at("searches").items()) {
        Search search{item.at("start").text(), {}};
        for (const Json& fold : item.at("folds").items()) search.folds.push_back(foldOf(fold));
        record.searches.push_back(search);
    }
    for (const Json& item : json.at("scores").items()) {
        record.scores.push_back({item.at("data").text(), item.at("drive").text(),
                                 countsOf(item.at("present")), listOfCounts(item.at("with_all")),
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
        settings.push_back({{"key", s.key}, {"present", s.present}, {"tried", list(s.tried)}});
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
                   {"seeds", list(record.seeds)},
                   {"hard_sets", list(record.hard_sets)},
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
        return recordOf(Json::parse(text));
    } catch (const std::runtime_error& e) {
        throw std::runtime_error(
            file.string() +
            ": is no record of scripts/select-settings, which makes it anew: " + e.what());
    }
}

}  // namespace hagen::selection
