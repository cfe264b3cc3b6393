#include <hagen/base/NumberText.h>
#include <hagen/base/ReadFile.h>
#include <hagen/trials/Measured.h>

#include <fstream>
#include <stdexcept>

#include "Words.h"

namespace hagen::trials {
namespace {

std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
        if (c == ',') {
            fields.emplace_back();
        } else if (c != '\r') {
            fields.back() += c;
        }
    }
    return fields;
}

double numberIn(const std::string& text) {
    const auto value = base::numberFrom<double>(text);
    if (!value) throw std::runtime_error("\"" + text + "\" is not a number");
    return *value;
}

void add(const std::string& text, std::vector<double>& values) {
    if (!text.empty()) values.push_back(numberIn(text));
}

/// What flew, and under which condition. Tables without air and distance are older.
Run runOf(const std::vector<std::string>& names, const std::vector<std::string>& fields) {
    Run run{};
    TrialSetup& setup = run.setup;
    setup.air = Air::Clear;
    setup.distance = ModelDistance::AsStored;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const std::string &name = names[c], &text = fields[c];
        if (name == "model") setup.model = text;
        if (name == "guidance") setup.guidance = text;
        if (name == "planner") setup.planner = text;
        if (name == "speed") setup.speed_m_s = numberIn(text);
        if (name == "latency_scale") setup.latency_scale = numberIn(text);
        if (name == "pose_error") setup.pose_error = poseErrorFrom(text);
        if (name == "unknown") setup.brakes_in_known_space = wordFrom<int>(text, kUnknowns) == 1;
        if (name == "air") setup.air = airFrom(text);
        if (name == "distance") setup.distance = distanceFrom(text);
        if (name == "updates") setup.updates = updatesFrom(text);
    }
    return run;
}

}  // namespace

void addMeasured(const std::string& header, const std::string& row, MeasuredByContender& all) {
    const std::vector<std::string> names = fieldsOf(header), fields = fieldsOf(row);
    if (fields.size() != names.size())
        throw std::runtime_error("number of fields differs from the header");
    Run run;
    try {
        run = runOf(names, fields);
    } catch (const std::invalid_argument& e) {  // of a word
        throw std::runtime_error(e.what());
    }
    MeasuredRuns& runs = all[{conditionOf(run), contenderOf(run)}];
    const std::string median = "_p50_ms";
    for (std::size_t c = 0; c < names.size(); ++c) {
        const std::string& name = names[c];
        if (name == "peak_model_bytes") add(fields[c], runs.peak_model_bytes);
        if (name.size() > median.size() &&
            name.compare(name.size() - median.size(), median.size(), median) == 0) {
            add(fields[c], runs.p50_ms[name.substr(0, name.size() - median.size())]);
        }
    }
}

MeasuredByContender readMeasured(const std::filesystem::path& file) {
    std::ifstream in = base::openToRead(file);
    MeasuredByContender all;
    std::string header, row;
    base::nextLine(in, header, file);
    for (int line = 2; base::nextLine(in, row, file); ++line) {
        try {
            addMeasured(header, row, all);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + e.what());
        }
    }
    if (in.bad()) throw std::runtime_error(file.string() + ": cannot be read");
    return all;
}

}  // namespace hagen::trials
