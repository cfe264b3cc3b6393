#include "SelectionTables.h"

#include <cmath>
#include <functional>
#include <vector>

#include "support/Tables.h"

namespace hagen::selection {
namespace {

using CountsOf = std::function<const Counts&(const DriveScores&)>;
using ClassOf = evaluation::ClassScore evaluation::Scores::*;

const Counts& presentOf(const DriveScores& scores) { return scores.present; }
CountsOf leftOutOf(std::size_t search) {
    return [search](const DriveScores& s) -> const Counts& { return s.left_out.at(search); };
}
CountsOf withAllOf(std::size_t search) {
    return [search](const DriveScores& s) -> const Counts& { return s.with_all.at(search); };
}

MeanInterval meanOf(const Record& record, const std::string& data, const CountsOf& countsOf,
                    ClassOf of_class) {
    std::vector<double> f1;
    for (const DriveScores& scores : record.scores) {
        const double value = (countsOf(scores).scores.*of_class).f1();
        if (scores.data == data && !std::isnan(value)) f1.push_back(value);
    }
    return meanOverDrives(f1);
}

std::string meanCell(const Record& record, const std::string& data, const CountsOf& countsOf) {
    return pairCell(meanOf(record, data, countsOf, &evaluation::Scores::roi).mean,
                    meanOf(record, data, countsOf, &evaluation::Scores::rou).mean);
}

std::string intervalCell(const Record& record, const std::string& data, std::size_t search,
                         ClassOf of_class) {
    const MeanInterval interval = meanOf(record, data, leftOutOf(search), of_class);
    return cell(evaluation::Interval{interval.low, std::fmin(interval.high, 1)});
}

std::string missedCell(const Record& record, const std::string& data, const CountsOf& countsOf) {
    evaluation::Missed missed;
    for (const DriveScores& scores : record.scores) {
        if (scores.data == data) missed += countsOf(scores).missed;
    }
    return hagen::missedCell(missed);
}

/// The description of a search's start, unless it is the first search.
std::string from(const Record& record, std::size_t search) {
    return search == 0 ? "" : ", from " + record.searches[search].start;
}

template <class CellOf>
void addLine(Table& table, const Record& record, const std::string& what, CellOf cellOf) {
    std::vector<std::string> line{what};
    for (const std::string& data : record.data()) line.push_back(cellOf(data));
    table.add(line);
}

}  // namespace

std::string scoreTable(const Record& record) {
    std::vector<std::string> heads{"F1 of RoI / ROU"};
    for (const std::string& data : record.data()) heads.push_back(data);
    Table table(heads);
    for (const std::string& drive : record.drives()) {
        addLine(table, record, "drive " + drive + ", held out", [&](const std::string& data) {
            const DriveScores* scores = record.find(data, drive);
            if (scores == nullptr) return std::string("-");
            const evaluation::Scores& f1 = scores->left_out.at(0).scores;
            return pairCell(f1.roi.f1(), f1.rou.f1());
        });
    }
    for (std::size_t search = 0; search < record.searches.size(); ++search) {
        addLine(table, record, "**mean over drives, held out" + from(record, search) + "**",
                [&](const std::string& data) {
                    return "**" + meanCell(record, data, leftOutOf(search)) + "**";
                });
        addLine(table, record, "95 % interval of RoI", [&](const std::string& data) {
            return intervalCell(record, data, search, &evaluation::Scores::roi);
        });
        addLine(table, record, "95 % interval of ROU", [&](const std::string& data) {
            return intervalCell(record, data, search, &evaluation::Scores::rou);
        });
    }
    addLine(table, record, "mean, chosen with all drives: in-sample",
            [&](const std::string& data) { return meanCell(record, data, withAllOf(0)); });
    addLine(table, record, "mean, `default`: in-sample",
            [&](const std::string& data) { return meanCell(record, data, presentOf); });
    for (std::size_t search = 0; search < record.searches.size(); ++search) {
        addLine(
            table, record, "missed above 0.5 m, held out" + from(record, search),
            [&](const std::string& data) { return missedCell(record, data, leftOutOf(search)); });
    }
    addLine(table, record, "missed above 0.5 m, `default`: in-sample",
            [&](const std::string& data) { return missedCell(record, data, presentOf); });
    return table.text();
}

std::string meanTable(const Record& record) {
    std::vector<std::string> heads{"F1 of RoI / ROU"};
    for (std::size_t search = 0; search < record.searches.size(); ++search) {
        heads.push_back("held out" + from(record, search));
        heads.push_back("95 % interval of RoI");
    }
    heads.push_back("`default`: in-sample");
    Table table(heads);
    for (const std::string& data : record.data()) {
        std::vector<std::string> line{data};
        for (std::size_t search = 0; search < record.searches.size(); ++search) {
            line.push_back(meanCell(record, data, leftOutOf(search)));
            line.push_back(intervalCell(record, data, search, &evaluation::Scores::roi));
        }
        line.push_back(meanCell(record, data, presentOf));
        table.add(line);
    }
    return table.text();
}

std::string meanList(const Record& record) {
    std::string list;
    for (const std::string& data : record.data()) {
        list += (list.empty() ? "" : "; ") + data + " " + meanCell(record, data, leftOutOf(0));
    }
    return list;
}

Table choiceTable(const Record& record, const Search& search) {
    std::vector<std::string> heads{"setting", "`default`"};
    for (const Fold& fold : search.folds)
        heads.push_back(fold.left_out.empty() ? "with all drives" : "without " + fold.left_out);
    Table table(heads);
    for (std::size_t s = 0; s < record.settings.size(); ++s) {
        const TriedSetting& setting = record.settings[s];
        std::vector<std::string> line{"`" + setting.key + "`", setting.present};
        for (const Fold& fold : search.folds) {
            const std::string& value = fold.chosen.at(s);
            line.push_back(value == setting.present ? value : "**" + value + "**");
        }
        table.add(line);
    }
    return table;
}

Table foldTable(const Search& search) {
    Table table({"held out", "objective", "missed, real", "missed, simulated", "missed, hard sets",
                 "rounds"});
    for (const Fold& fold : search.folds) {
        std::vector<std::string> line{fold.left_out.empty() ? "none" : "drive " + fold.left_out,
                                      cell(fold.start, 4) + " to " + cell(fold.objective, 4)};
        for (std::size_t group = 0; group < kGroups; ++group) {
            line.push_back(std::to_string(fold.missed_start[group]) + " to " +
                           std::to_string(fold.missed[group]) + ", limit " +
                           std::to_string(fold.limit[group]));
        }
        line.push_back(std::to_string(fold.rounds));
        table.add(line);
    }
    return table;
}

}  // namespace hagen::selection
