#include <hagen/base/NumberText.h>
#include <hagen/pages/Table.h>
#include <cmath>

namespace hagen::pages {

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

/// Puts the interval that follows a figure in brackets on a line of its own, which halves the table
/// width.
std::string htmlField(const std::string& field) {
    const std::size_t bracket = field.find(" (");
    if (bracket == std::string::npos || field.back() != ')') return htmlText(field);
    return htmlText(field.substr(0, bracket)) + " <small>" + htmlText(field.substr(bracket + 1)) +
           "</small>";
}

/// A text that stays in its field, whatever bars and line ends it has.
std::string markdownField(const std::string& field) {
    std::string escaped;
    for (const char c : field) {
        if (c == '|' || c == '\\' || c == '<') escaped += '\\';
        escaped += c == '\n' || c == '\r' ? ' ' : c;
    }
    return escaped;
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
    for (const std::string& name : table.header) text += " " + markdownField(name) + " |";
    text += "\n|---|";
    for (std::size_t c = 1; c < table.header.size(); ++c) text += "--:|";
    for (const auto& row : table.rows) {
        text += "\n|";
        for (const std::string& field : row) text += " " + markdownField(field) + " |";
    }
    return text + "\n";
}

std::string figure(double value, int decimals) {
    return std::isfinite(value) ? base::fixedText(value, decimals) : "-";
}

}  // namespace hagen::pages
