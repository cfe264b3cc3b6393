#pragma once
#include <hagen/logs/Conversion.h>
#include <hagen/logs/LearnAirframe.h>

/// Prints the results and outputs of a conversion to standard output.
void printSummary(const hagen::logs::Conversion& conversion,
                  const hagen::logs::ConversionReport& report);

/// Prints what was learned to standard output, and to standard error a warning if it is too much.
void printAirframe(const hagen::logs::AirframeLearning& learning,
                   const hagen::logs::AirframeReport& report);

/// Prints every key of settings files with default, range and meaning, as a Markdown table.
void printSettingsKeys();
