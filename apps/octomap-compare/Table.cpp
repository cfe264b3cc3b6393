#include "Table.h"

#include <array>
#include <charconv>
#include <cmath>

namespace hagen {

std::string htmlText(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

namespace {

/// A figure's interval, in brackets at its end, goes below it: tables get half as wide.
std::string htmlField(const std::string& field) {
    const std::size_t bracket = field.find(" (");
    if (bracket == std::string::npos || field.back() != ')') return htmlText(field);
    return htmlText(field.substr(0, bracket)) + " <small>" + htmlText(field.substr(bracket + 1)) +
           "</small>";
}

}  // namespace

std::string htmlOf(const Table& table) {
    std::string html = "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string& name : table.header) html += "<th>" + htmlText(name) + "</th>";
    html += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (std::size_t c = 0; c < row.size(); ++c) {
            html += (c == 0 ? "<th scope=\"row\">" : "<td>") +
                    (c == 0 ? htmlText(row[c]) : htmlField(row[c])) + (c == 0 ? "</th>" : "</td>");
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string markdownOf(const Table& table) {
    std::string text = "|";
    for (const std::string& name : table.header) text += " " + name + " |";
    text += "\n|---|";
    for (std::size_t c = 1; c < table.header.size(); ++c) text += "--:|";
    for (const auto& row : table.rows) {
        text += "\n|";
        for (const std::string& field : row) text += " " + field + " |";
    }
    return text + "\n";
}

std::string fixed(double value, int decimals) {
    if (!std::isfinite(value)) return "-";
    std::array<char, 400> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::fixed, decimals);
    const std::string written(text.data(), end.ptr);
    const bool is_zero = written.find_first_not_of("-0.") == std::string::npos;
    return is_zero && written[0] == '-' ? written.substr(1) : written;
}

std::string fixed(const Bounds& bounds, int decimals) {
    return fixed(bounds.low, decimals) + " to " + fixed(bounds.high, decimals);
}

std::string percent(double share) { return fixed(100 * share, 1); }

std::string percentOf(int successes, int trials) {
    if (trials == 0) return "-";
    const Bounds bounds = wilsonInterval(successes, trials);
    return percent(static_cast<double>(successes) / trials) + " (" + percent(bounds.low) + " to " +
           percent(bounds.high) + ")";
}

std::string percentOfRuns(int successes, int runs) {
    if (runs == 0) return "-";
    std::string text = percentOf(successes, runs);
    text.insert(text.size() - 1, "; " + std::to_string(runs));
    return text;
}

std::string pText(double p) { return p < 0.001 ? "<0.001" : fixed(p, 3); }

}  // namespace hagen
