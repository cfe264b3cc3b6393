// Writes docs/performance.md and its figure.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ConversionTimes.h"
#include "Flights.h"
#include "TimedRows.h"

namespace hagen {

struct Performance {
    std::vector<TimedRow> rows;      ///< from stage-benchmarks
    FlightTimes table;               ///< the flight of the run time table
    std::vector<FlightTimes> chart;  ///< the flights of the figure
    std::vector<ConversionTimes> conversions;
    std::string revision;
    bool is_quick = false;
};

std::string documentOf(const Performance& performance);
/// Draws by_flight.svg.
void drawFlights(const std::filesystem::path& folder, const std::vector<FlightTimes>& flights);

}  // namespace hagen
