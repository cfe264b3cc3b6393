#include "support/Tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hagen {

std::string Table::text() const {
    std::vector<std::size_t> widths(lines_.front().size(), 3);
    for (const auto& line : lines_) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            widths[c] = std::max(widths[c], line[c].size());
        }
    }
    std::string text;
    for (std::size_t l = 0; l < lines_.size(); ++l) {
        text += "|";
        for (std::size_t c = 0; c < widths.size(); ++c) {
            const std::string& words = lines_[l][c];
            text += " " + words + std::string(widths[c] - words.size(), ' ') + " |";
        }
        text += "\n";
        if (l > 0) continue;
        text += "|";
        for (const std::size_t width : widths) text += std::string(width + 2, '-') + "|";
        text += "\n";
    }
    return text + "\n";
}

std::string Table::csv() const {
    std::string text;
    for (const auto& line : lines_) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            std::string words;
            for (const char character : line[c]) {
                if (character != '*' && character != '`') words += character;
            }
            if (words.find(',') != std::string::npos) words = '"' + words + '"';
            text += (c > 0 ? "," : "") + words;
        }
        text += "\n";
    }
    return text;
}

std::string cell(double value, int digits) {
    if (std::isnan(value)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string cell(const evaluation::Interval& interval) {
    return std::isnan(interval.low) ? "-" : cell(interval.low) + " to " + cell(interval.high);
}

std::string boldAbove(double value, double other) {
    const std::string text = cell(value);
    return value > other && text != cell(other) ? "**" + text + "**" : text;
}

std::string pairCell(double roi, double rou, double best_roi, double best_rou) {
    const auto one = [](double value, double best) {
        const std::string text = cell(value);
        return !std::isnan(value) && text == cell(best) ? "**" + text + "**" : text;
    };
    return one(roi, best_roi) + " / " + one(rou, best_rou);
}

std::string missedCell(const evaluation::Missed& missed) {
    if (missed.all == 0) return "-";
    return std::to_string(missed.missed) + " of " + std::to_string(missed.all) + " (" +
           cell(100 * missed.share(), 2) + " %)";
}

std::string pairCell(double roi, double rou) { return pairCell(roi, rou, NAN, NAN); }

}  // namespace hagen
