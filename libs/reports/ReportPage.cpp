#include <algorithm>
#include <cmath>

#include <hagen/base/Quantile.h>
#include <hagen/pages/Page.h>
#include <hagen/reports/Report.h>
#include <hagen/reports/ReportWords.h>
#include <hagen/reports/SharedCourses.h>
#include <hagen/reports/Verdict.h>
#include "ReportTables.h"
#include "ReportTexts.h"
#include "SummaryJson.h"

namespace hagen::reports {
namespace {

using base::Json;

/// A part of the report; HTML and Markdown are made from the same ones.
struct Section {
    std::string title;
    std::vector<std::string> words;
    std::vector<pages::Table> tables;
    std::vector<std::string> charts{};  ///< ids that the page's script draws
    std::string html{};                 ///< more, on the page alone
    bool is_long = false;               ///< folded on the page, left out of documents
    bool is_list = false;               ///< words are a list
};

Section conditionSection(const Summary& summary, const trials::Condition& condition) {
    return {"Outcomes at " + nameOf(condition),
            {"Success in percent (Wilson's 95 % interval; runs)."},
            {successTable(summary, condition)}};
}

void addOutcomes(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    Section first = conditionSection(summary, reference);
    first.charts = {"success"};
    sections.push_back(first);
    sections.push_back(
        {"Collisions at " + nameOf(reference),
         {"Collisions in percent (Wilson's 95 % interval; runs). A collision is a true "
          "clearance under 0.30 m."},
         {collisionTable(summary, reference)}});
    for (std::size_t c = 1; c < summary.conditions.size(); ++c) {
        sections.push_back(conditionSection(summary, summary.conditions[c]));
    }
    for (const trials::Condition& condition : summary.conditions) {
        Section all{"Success, collision and timeout at " + nameOf(condition) + ", every cell",
                    {},
                    {outcomeTable(summary, condition)}};
        all.is_long = true;
        sections.push_back(all);
    }
}

void addPairings(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    sections.push_back(
        {"The same courses, pair by pair",
         {"Success of the first less that of the second on courses that both flew; Newcombe's 95 % "
          "interval; McNemar's exact test with Holm's correction. \"Not inferior\": the interval "
          "excludes a loss of " +
          pages::figure(100 * kMargin, 0) +
          " points; \"open\": it does not, but holds smaller losses, too. \"All\": all "
          "scenarios that both flew. Intervals, and so \"not inferior\", and the p of collisions "
          "are not corrected for the number of comparisons; p (Holm) is."},
         {pairingTable(summary.overall)}});
    Section each{"The same, in each scenario", {}, {pairingTable(summary.pairings)}};
    each.is_long = true;
    sections.push_back(each);
    const pages::Table square = squareTable(summary, summary.conditions.front());
    if (!square.rows.empty() && square.header.size() > 3) {
        sections.push_back(
            {"World model by guidance",
             {"Success in percent (interval; runs) at " + nameOf(summary.conditions.front()) +
              ": is it the map, or the search for a way, that helps?"},
             {square}});
    }
    const std::vector<Pairing> losses = lossesOf(summary);
    const auto significant = std::count_if(
        losses.begin(), losses.end(), [](const Pairing& pairing) { return pairing.p_holm < 0.05; });
    const auto compared =
        std::count_if(summary.pairings.begin(), summary.pairings.end(),
                      [](const Pairing& pairing) { return pairing.second.model != "oracle"; });
    Section loses{
        "Where W-RoI loses",
        {"Of " + std::to_string(compared) +
         " comparisons in single scenarios, W-RoI has less success in " +
         std::to_string(losses.size()) + "; significant after Holm's correction (p < 0.05): " +
         std::to_string(significant) + ". The others may be chance. Largest loss first."},
        {}};
    if (!losses.empty()) loses.tables.push_back(pairingTable(losses));
    sections.push_back(loses);
}

void addFlights(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    const std::string at = " at " + nameOf(reference);
    if (!summary.speed_limits.empty()) {
        Section speed{"Success against speed",
                      {"Lines are success with 95 % intervals; the dashed line is 95 %."},
                      {speedTable(summary)}};
        speed.charts = {"speed"};
        sections.push_back(speed);
    }
    Section flight{"How they fly" + at,
                   {"Only courses on which all contenders of a table arrived: medians with "
                    "bootstrap 95 % intervals. Those that flew fewer courses come in with a table "
                    "of their own. First reaction: the free way ahead when the vehicle "
                    "first left its course, where all did. The chart has all courses that all "
                    "flew, whatever came out."},
                   {}};
    for (const SharedCourses& shared : sharedCourses(report.flown.runs, summary, reference)) {
        flight.words.push_back(sharedWords(shared));
        if (!shared.cells.empty()) flight.tables.push_back(flightTable(shared));
    }
    flight.charts = {"clearance"};
    sections.push_back(flight);
}

/// Wires by contender, and W-RoI against W-Full with and without them.
void addWires(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    const pages::Table table = wiresTable(summary, reference);
    if (table.rows.empty()) return;
    Section wires{"Wires, and where none are, at " + nameOf(reference),
                  {"What the filter takes away may be a wire: W-RoI against W-Full, which keeps "
                   "all points."},
                  {table}};
    for (const Pairing& pairing : summary.overall) {
        if (!(pairing.condition == reference)) continue;
        for (const Pairing& apart : wiresApart(summary, pairing)) {
            wires.words.push_back(differenceText(apart));
        }
    }
    sections.push_back(wires);
}

void addEffort(const Report& report, std::vector<Section>& sections) {
    const Summary& summary = report.summary;
    const trials::Condition& reference = summary.conditions.front();
    Section effort{"Time from sensor to command at " + nameOf(reference),
                   {"From the end of a turn to the command: waiting and all stages. Medians over "
                    "a contender's own runs of a run's p50 and p95. A scan that waits when a newer "
                    "one comes is "
                    "dropped. Who flew straight flew other scenarios: compare within a guidance "
                    "alone."},
                   {effortTable(summary, reference)}};
    effort.charts = {"command"};
    sections.push_back(effort);
    if (report.profile) {
        Section stages{"Time of each stage",
                       {"By the latency profile, one core of " + report.profile->machine + "."},
                       {stageTable(summary, *report.profile)}};
        stages.charts = {"stages"};
        sections.push_back(stages);
    }
    if (!report.flown.measured.empty()) {
        sections.push_back({"Memory and CPU time, measured while flying",
                            {"On the machine that flew the campaign, perhaps on several cores at a "
                             "time: medians over runs. Flights draw their latencies from the "
                             "profile, not from these. Heap is what a model held at most."},
                            {measuredTable(report.flown.measured)}});
    }
    if (!report.memory.empty()) {
        Section memory{"Memory against distance",
                       {"Heap that a model holds, measured. One flight through forest-0.05 is "
                        "repeated, each time "
                        "from where it ended; the grid is allocated for the whole length at once. "
                        "OctoMaps are not pruned "
                        "in flight, which is quicker; pruned, they would hold about 0.6 of it."},
                       {memoryTable(report.memory)}};
        memory.charts = {"memory"};
        sections.push_back(memory);
    }
}

std::string captionOf(const replays::OverheadView& view) {
    const trials::Run& run = view.run;
    std::string text = run.scenario + ", seed " + std::to_string(run.seed) + ", " +
                       nameOf(trials::Contender{run.setup.model, run.setup.guidance}) + ", " +
                       pages::figure(run.setup.speed_m_s, 1) +
                       " m/s: " + nameOf(run.result.outcome) + " after " +
                       pages::figure(run.result.time_s, 1) + " s, least clearance " +
                       pages::figure(run.result.min_clearance_m, 2) + " m.";
    if (!view.is_same) text += " Flown again it came out otherwise: another version, or machine?";
    return text;
}

void addWorst(const Report& report, std::vector<Section>& sections) {
    if (report.worst.empty() && report.worst_missing.empty()) return;
    Section worst{"The worst runs, from above", {}, {}};
    if (!report.worst.empty()) {
        worst.words.push_back(
            "Flown again from their seeds: collisions first, then timeouts, by clearance; one of "
            "each "
            "scenario and contender.");
        worst.html = replays::overheadLegend();
    }
    worst.words.insert(worst.words.end(), report.worst_missing.begin(), report.worst_missing.end());
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
    const std::string unfinished = unfinishedWords(report.flown);
    if (!unfinished.empty()) verdict.words.insert(verdict.words.begin(), unfinished);
    sections.push_back(verdict);
    Section flown{"What was flown", flownWords(report), {}};
    if (!unfinished.empty()) {
        flown.words.push_back(unfinished);
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
    for (const std::string& words : section.words) {
        const std::string tag = section.is_list ? "li" : "p";
        text += "<" + tag + ">" + pages::htmlText(words) + "</" + tag + ">\n";
    }
    if (section.is_list) text += "</ul>";
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

/// The distribution of least clearances on courses that all of a guidance flew: quantiles at 0,
/// 0.02, ..., 1.
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
            stages.push_back({{"stage", stage.substr(stage.find('/') + 1)},
                              {"p50_ms", base::quantile(q, 0.5)},
                              {"p95_ms", base::quantile(q, 0.95)}});
        }
        all.push_back(
            {{"model", contender.model}, {"guidance", contender.guidance}, {"stages", stages}});
    }
    return all;
}

/// What the page's charts are drawn from.
Json dataOf(const Report& report) {
    Json data{{"summary", jsonOf(report.summary)}};
    if (report.summary.conditions.empty()) return data;
    data["reference"] = nameOf(report.summary.conditions.front());
    data["clearances"] = clearancesOf(report);
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
    std::string text = "# Mapped against mapping-free avoidance\n";
    for (const Section& section : sectionsOf(report)) {
        if (section.is_long || (!section.html.empty() && section.tables.empty())) continue;
        if (text.substr(text.size() - 2) != "\n\n") text += "\n";
        text += "## " + section.title + "\n\n";
        for (const std::string& words : section.words) {
            text += section.is_list ? "- " + words + "\n" : words + "\n\n";
        }
        for (const pages::Table& table : section.tables) text += pages::markdownOf(table) + "\n";
    }
    return text;
}

}  // namespace hagen::reports
