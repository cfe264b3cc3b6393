#include <algorithm>
#include <cmath>

#include <hagen/avoidance/WorldModel.h>
#include <hagen/base/Quantile.h>
#include <hagen/pages/Page.h>
#include <hagen/reports/Answer.h>
#include <hagen/reports/Report.h>
#include <hagen/reports/ReportSentences.h>
#include <hagen/reports/SharedCourses.h>
#include <hagen/reports/Verdict.h>
#include "OracleSentences.h"
#include "ReportTables.h"
#include "ReportTexts.h"
#include "ScenarioSentences.h"
#include "SummaryJson.h"

namespace hagen::reports {
namespace {

using base::Json;

/// A section of the report, for HTML and Markdown.
struct Section {
    std::string title;
    std::vector<std::string> paragraphs;
    std::vector<pages::Table> tables;
    std::vector<std::string> charts{};  ///< ids that the page's script draws
    std::string chart_caption{};        ///< only on the page, where the charts are
    std::string html{};                 ///< more content, only on the page
    bool is_long = false;               ///< folded on the page, left out of Markdown
    bool is_list = false;               ///< paragraphs are list items
};

Section conditionSection(const Summary& summary, const trials::Condition& condition) {
    Section section{"Success at " + nameOf(condition),
                    {"Success rate in percent (95 % Wilson interval; number of runs)."},
                    {successTable(summary, condition)}};
    for (const std::string& sentence : saturationSentences(summary, condition)) {
        section.paragraphs.push_back(sentence);
    }
    return section;
}

void addOutcomes(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    Section first = conditionSection(summary, reference);
    first.charts = {"success"};
    sections.push_back(first);
    sections.push_back(
        {"Collisions at " + nameOf(reference),
         {"Collision rate in percent (95 % Wilson interval; number of runs). A collision is a true "
          "clearance below 0.30 m."},
         {collisionTable(summary, reference)}});
    const pages::Table saturation = saturationTable(summary, reference);
    if (!saturation.rows.empty()) {
        sections.push_back(
            {"Scenarios that tell world models apart",
             {"A scenario is saturated for a contender if it and each other model differ on no "
              "course, or both succeed on at least " +
              std::to_string(kCeilingPercent) +
              " % of the courses that both flew. It then says nothing about the models. Last "
              "column: the lowest speed flown at which it is not saturated."},
             {saturation}});
    }
    for (std::size_t c = 1; c < summary.conditions.size(); ++c) {
        sections.push_back(conditionSection(summary, summary.conditions[c]));
    }
    for (const trials::Condition& condition : summary.conditions) {
        Section all{"Success, collisions and timeouts at " + nameOf(condition) +
                        ", by scenario and contender",
                    {},
                    {outcomeTable(summary, condition)}};
        all.is_long = true;
        sections.push_back(all);
    }
}

/// Adds a section with the table of the pairings that are not saturated, and one with all of them.
void addUnsaturated(Section section, const std::vector<Pairing>& pairings,
                    std::vector<Section>& sections) {
    std::vector<Pairing> unsaturated;
    std::copy_if(pairings.begin(), pairings.end(), std::back_inserter(unsaturated),
                 [](const Pairing& pairing) { return answerOf(pairing) != Answer::Saturated; });
    if (unsaturated.empty()) {
        section.paragraphs.push_back("All are saturated.");
    } else {
        section.paragraphs.push_back("The table has those that are not saturated.");
        section.tables.push_back(pairingTable(unsaturated));
    }
    sections.push_back(section);
    Section all{section.title + ", with those that are saturated", {}, {pairingTable(pairings)}};
    all.is_long = true;
    sections.push_back(all);
}

void addScenarioPairings(const Summary& summary, std::vector<Section>& sections) {
    const std::string margin = pages::figure(100 * kMargin, 0);
    Section section{
        "Paired comparisons in each scenario",
        {"Difference: success rate of the first contender minus that of the second on the courses "
         "that both flew, with Newcombe's 95 % interval. p (Holm): McNemar's exact test with "
         "Holm's correction over all comparisons in single scenarios; \"-\": too few courses "
         "differ for the test to be significant, so the comparison is left out. \"Saturated\": "
         "the two differ on no course, or both succeed on at least " +
             std::to_string(kCeilingPercent) +
             " %. \"Not inferior\": the interval excludes a loss of " + margin +
             " points. \"Inferior\": it contains only larger losses. \"Undecided\": it contains "
             "a loss of " +
             margin +
             " points. Only p (Holm) is corrected for the number of comparisons. The intervals, "
             "and with them \"not inferior\", and the p of collisions are not.",
         leftOutSentence(summary.pairings, "in single scenarios")},
        {}};
    addUnsaturated(section, summary.pairings, sections);
}

/// How far the models are from the true scene.
void addGaps(const Summary& summary, std::vector<Section>& sections) {
    if (summary.to_oracle.empty()) return;
    Section section{"Gap to the true scene",
                    {"Each model (first) against the true scene (second) with the same guidance. "
                     "What the true scene does not reach is lost by planner and guidance, which "
                     "take the world to stand still, the "
                     "difference by the model. p (Holm) is corrected over these comparisons.",
                     leftOutSentence(summary.to_oracle, "with the true scene")},
                    {}};
    for (std::string& sentence :
         oracleSentencesAtOtherSpeeds(summary, summary.conditions.front())) {
        section.paragraphs.push_back(std::move(sentence));
    }
    addUnsaturated(std::move(section), summary.to_oracle, sections);
}

void addPairings(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    if (summary.pairings.empty()) {
        sections.push_back({"Paired comparisons in each scenario",
                            {"No two models to compare flew the same course."},
                            {}});
        addGaps(summary, sections);
        return;
    }
    addScenarioPairings(summary, sections);
    sections.push_back(
        {"Paired comparisons over all scenarios",
         {"As above, over all scenarios that both flew. A total says little about the scenarios "
          "without a difference: their number is given, and \"not inferior\" holds only together "
          "with it. So is the number of courses of the scenario that has the most of them. Thin "
          "wires hang where the wires of the same seed do: where both flew those, too, they are "
          "left out."},
         {pooledTable(summary.overall)}});
    addGaps(summary, sections);
    const pages::Table square = squareTable(summary, summary.conditions.front());
    if (!square.rows.empty() && square.header.size() > 3) {
        sections.push_back({"World model by guidance",
                            {"Success rate in percent (95 % Wilson interval; number of runs) at " +
                             nameOf(summary.conditions.front()) +
                             ". It shows whether the map or the path search makes the difference."},
                            {square}});
    }
    const std::vector<Pairing> losses = lossesOf(summary);
    Section loses{"Where the RoI window succeeds less often", {lossesSentence(summary)}, {}};
    if (!losses.empty()) loses.tables.push_back(pairingTable(losses));
    sections.push_back(loses);
}

void addFlights(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    const std::string at = " at " + nameOf(reference);
    if (!summary.speed_limits.empty()) {
        Section speed{"Success and speed",
                      {"The highest speed up to which the success rate, or the lower bound of its "
                       "95 % Wilson interval, is at least 95 %."},
                      {speedTable(summary)}};
        speed.charts = {"speed"};
        speed.chart_caption = "Success rates with 95 % intervals; the dashed line is 95 %.";
        sections.push_back(speed);
    }
    Section flight{
        "Flight quality" + at,
        {"Medians with bootstrap 95 % intervals over the courses on which all contenders "
         "of a table reached the goal. Contenders that flew fewer courses appear in a "
         "table of their own. First reaction: true free distance ahead when a command "
         "first left the straight line or slowed down, over courses on which all "
         "reacted."},
        {}};
    for (const SharedCourses& shared : sharedCourses(report.flown.runs, summary, reference)) {
        flight.paragraphs.push_back(sharedCoursesSentence(shared));
        if (!shared.cells.empty()) flight.tables.push_back(flightTable(shared));
    }
    flight.charts = {"clearance"};
    flight.chart_caption =
        "The charts cover all courses that all contenders flew, whatever the outcome.";
    sections.push_back(flight);
}

/// Outcomes on wires by contender, and W-RoI against W-Full without and on wires.
void addWires(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    const pages::Table table = wiresTable(summary, reference);
    if (table.rows.empty()) return;
    Section wires{"Courses with and without wires at " + nameOf(reference),
                  {"The filter may remove a wire, so the RoI window is compared with the full "
                   "window, which keeps all points. The table covers the courses with wires."},
                  {table}};
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == reference)) continue;
        for (const Pairing& apart : splitByWires(summary, pairing)) {
            wires.paragraphs.push_back(differenceText(apart));
        }
    }
    sections.push_back(wires);
}

void addEffort(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    Section effort{
        "Latency from sensor to command at " + nameOf(reference),
        {"From the end of a scan to the command, including waiting and all stages: "
         "medians of the p50 and p95 of each run, over the courses that all contenders of a table "
         "flew, whatever the outcome. A waiting scan is dropped when a newer one arrives."},
        {}};
    for (const SharedCourses& shared : sharedCourses(report.flown.runs, summary, reference)) {
        effort.paragraphs.push_back(flownTogetherSentence(shared));
        if (shared.flown > 0) effort.tables.push_back(effortTable(shared));
    }
    effort.charts = {"command"};
    sections.push_back(effort);
    if (report.profile) {
        Section stages{
            "Time of each stage",
            {"From the latency profile, measured on one core of " + report.profile->machine + "."},
            {stageTable(summary, *report.profile)}};
        stages.charts = {"stages"};
        sections.push_back(stages);
    }
    const pages::Table measured = measuredTable(report.flown.measured, reference);
    if (!measured.rows.empty()) {
        sections.push_back(
            {"Memory and CPU time measured during the flights at " + nameOf(reference),
             {"Medians over runs, measured on the machine that flew the campaign, "
              "possibly with several processes at a time. Flights draw their "
              "latencies from the profile, not from these times. Peak heap is the "
              "maximum that a model held during a run. Contenders flew different "
              "numbers of courses of each scenario."},
             {measured}});
    }
    if (!report.memory.empty()) {
        Section memory{
            "Memory over distance flown",
            {"Measured heap of each model along one flight through forest-0.05, repeated "
             "end to end. The grid is allocated for the whole length at once. OctoMaps "
             "are not pruned in flight, which is faster; pruned, they would take about "
             "0.6 of this memory."},
            {memoryTable(report.memory)}};
        memory.charts = {"memory"};
        sections.push_back(memory);
    }
}

std::string captionOf(const replays::OverheadView& view) {
    const trials::Run& run = view.run;
    std::string text = run.scenario + ", seed " + std::to_string(run.seed) + ", " +
                       nameOf(trials::contenderOf(run)) + ", " + nameOf(trials::conditionOf(run)) +
                       ": " + nameOf(run.result.outcome) + " after " +
                       pages::figure(run.result.time_s, 1) + " s, minimum clearance " +
                       pages::figure(run.result.min_clearance_m, 2) + " m.";
    if (!view.is_same) text += " Flown again, the result differs: another version or machine?";
    return text;
}

void addWorst(const Report& report, std::vector<Section>& sections) {
    if (report.worst.empty() && report.worst_missing.empty()) return;
    Section worst{"The worst runs from above", {}, {}};
    if (!report.worst.empty()) {
        worst.paragraphs.push_back(
            "Flown again from their seeds. Collisions first, then timeouts, by clearance; one per "
            "scenario and contender.");
        worst.html = replays::overheadLegend();
    }
    worst.paragraphs.insert(worst.paragraphs.end(), report.worst_missing.begin(),
                            report.worst_missing.end());
    worst.html += "<div class=\"views\">";
    for (const replays::OverheadView& view : report.worst) {
        worst.html += "<figure>" + replays::svgOf(view) + "<figcaption>" +
                      pages::htmlText(captionOf(view)) + "</figcaption></figure>\n";
    }
    worst.html += "</div>";
    sections.push_back(worst);
}

std::vector<Section> sectionsOf(const Report& report) {
    std::vector<Section> sections;
    Section verdict{"Verdict", verdictOf(report.summary), {}};
    verdict.is_list = true;
    const std::string unfinished = unfinishedSentence(report.flown);
    if (!unfinished.empty()) verdict.paragraphs.insert(verdict.paragraphs.begin(), unfinished);
    sections.push_back(verdict);
    Section flown{"Flights", flightSentences(report), {}};
    if (!unfinished.empty()) {
        flown.paragraphs.push_back(unfinished);
        flown.tables.push_back(shortfallTable(report.flown));
    }
    sections.push_back(flown);
    if (report.summary.conditions.empty()) return sections;
    addOutcomes(report, sections);
    addWires(report, sections);
    addPairings(report, sections);
    addFlights(report, sections);
    addEffort(report, sections);
    addWorst(report, sections);
    return sections;
}

std::string html(const Section& section) {
    std::string text;
    if (section.is_list) text += "<ul>";
    for (const std::string& paragraph : section.paragraphs) {
        const std::string tag = section.is_list ? "li" : "p";
        text += "<" + tag + ">" + pages::htmlText(paragraph) + "</" + tag + ">\n";
    }
    if (section.is_list) text += "</ul>";
    if (!section.chart_caption.empty()) {
        text += "<p>" + pages::htmlText(section.chart_caption) + "</p>\n";
    }
    for (const std::string& chart : section.charts) {
        text += "<div class=\"charts\" id=\"chart-" + chart + "\"></div>\n";
    }
    for (const pages::Table& table : section.tables) text += pages::htmlOf(table);
    text += section.html;
    const std::string title = pages::htmlText(section.title);
    if (section.is_long) {
        return "<details><summary>" + title + "</summary>\n" + text + "</details>\n";
    }
    return "<section><h2>" + title + "</h2>\n" + text + "</section>\n";
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// Latencies on courses that all contenders of a guidance flew, in milliseconds.
Json latenciesOf(const Report& report) {
    Json groups = Json::array();
    for (const SharedCourses& shared :
         sharedCourses(report.flown.runs, report.summary, report.summary.conditions.front())) {
        if (shared.flown == 0) continue;
        Json bars = Json::array();
        for (const Cell& cell : shared.flown_cells) {
            bars.push_back({{"model", cell.contender.model},
                            {"guidance", cell.contender.guidance},
                            {"p50_ms", number(cell.latency_p50_ms.median)},
                            {"p95_ms", number(cell.latency_p95_ms.median)},
                            {"max_ms", number(cell.latency_max_ms)}});
        }
        groups.push_back(
            {{"guidance", shared.guidance}, {"courses", shared.flown}, {"bars", bars}});
    }
    return groups;
}

/// The distribution of minimum clearances on courses that all contenders of a guidance flew:
/// quantiles at 0, 0.02, ..., 1.
Json clearancesOf(const Report& report) {
    Json groups = Json::array();
    for (const SharedCourses& shared :
         sharedCourses(report.flown.runs, report.summary, report.summary.conditions.front())) {
        if (shared.flown == 0) continue;
        Json curves = Json::array();
        for (std::size_t c = 0; c < shared.contenders.size(); ++c) {
            Json curve = Json::array();
            for (int i = 0; i <= 50; ++i) {
                curve.push_back(number(base::quantile(shared.min_clearances_m[c], i / 50.0)));
            }
            curves.push_back({{"model", shared.contenders[c].model},
                              {"guidance", shared.guidance},
                              {"quantiles_m", curve}});
        }
        groups.push_back(
            {{"guidance", shared.guidance}, {"courses", shared.flown}, {"curves", curves}});
    }
    return groups;
}

Json stagesJson(const Report& report) {
    Json all = Json::array();
    if (!report.profile) return all;
    for (const trials::Contender& contender : report.summary.contenders) {
        Json stages = Json::array();
        for (const std::string& stage :
             stageNamesOf(contender, report.summary.conditions.front().planner, *report.profile)) {
            const std::vector<double>& q = report.profile->quantiles_ms.at(stage);
            stages.push_back({{"stage", stageText(stage, "")},
                              {"of", stage.substr(stage.find_last_of("/+") + 1)},
                              {"p50_ms", base::quantile(q, 0.5)},
                              {"p95_ms", base::quantile(q, 0.95)}});
        }
        all.push_back(
            {{"model", contender.model}, {"guidance", contender.guidance}, {"stages", stages}});
    }
    return all;
}

/// The data of the page's charts.
Json dataOf(const Report& report) {
    Json data{{"summary", jsonOf(report.summary)}};
    if (report.summary.conditions.empty()) return data;
    for (const std::string& model : avoidance::worldModelNames()) {
        data["model_names"][model] = avoidance::displayName(model);
    }
    data["reference"] = nameOf(report.summary.conditions.front());
    data["clearances"] = clearancesOf(report);
    data["latencies"] = latenciesOf(report);
    data["stages"] = stagesJson(report);
    data["memory"] = Json::array();
    for (const trials::HeapCurve& curve : report.memory) {
        Json points = Json::array();
        for (const auto& [path_m, bytes] : curve.bytes_by_path_m) {
            points.push_back({number(path_m), number(1e-6 * bytes)});
        }
        data["memory"].push_back({{"model", curve.model}, {"megabytes_by_m", points}});
    }
    return data;
}

}  // namespace

std::string reportPage(const Report& report) {
    std::string body;
    for (const Section& section : sectionsOf(report)) body += html(section);
    return pages::filled(texts::report_html, {{"style", texts::report_css},
                                              {"body", body},
                                              {"data", pages::scriptText(dataOf(report).dump())},
                                              {"chart", texts::chart_js},
                                              {"script", texts::report_js}});
}

std::string reportMarkdown(const Report& report) {
    std::string text = "# Obstacle avoidance with and without a map\n";
    for (const Section& section : sectionsOf(report)) {
        if (section.is_long || (!section.html.empty() && section.tables.empty())) continue;
        if (text.substr(text.size() - 2) != "\n\n") text += "\n";
        text += "## " + section.title + "\n\n";
        for (const std::string& paragraph : section.paragraphs) {
            text += section.is_list ? "- " + paragraph + "\n" : paragraph + "\n\n";
        }
        for (const pages::Table& table : section.tables) text += pages::markdownOf(table) + "\n";
    }
    return text;
}

}  // namespace hagen::reports
