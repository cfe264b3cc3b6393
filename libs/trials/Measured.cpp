#include <hagen/base/NumberText.h>
#include <hagen/base/ReadFile.h>
#include <hagen/trials/Measured.h>
#include <hagen/trials/Updates.h>

#include <fstream>
#include <stdexcept>

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

void add(const std::string& text, std::vector<double>& values) {
    if (text.empty()) return;
    const auto value = base::numberFrom<double>(text);
    if (!value) throw std::runtime_error("\"" + text + "\" is not a number");
    values.push_back(*value);
}

}  // namespace

void addMeasured(const std::string& header, const std::string& row, MeasuredByModel& all) {
    const std::vector<std::string> names = fieldsOf(header), fields = fieldsOf(row);
    if (fields.size() != names.size())
        throw std::runtime_error("number of fields differs from the header");
    std::string model;
    for (std::size_t c = 0; c < names.size(); ++c) {
        if (names[c] == "model") model = fields[c];
        if (names[c] == "updates" && fields[c] != nameOf(Updates::Scans)) return;
    }
    MeasuredRuns& runs = all[model];
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

MeasuredByModel readMeasured(const std::filesystem::path& file) {
    std::ifstream in = base::openToRead(file);
    MeasuredByModel all;
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
