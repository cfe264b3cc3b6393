#pragma once
#include <hagen/logs/Conversion.h>

/// Prints the results and outputs of a conversion to standard output.
void printSummary(const hagen::logs::Conversion& conversion,
                  const hagen::logs::ConversionReport& report);

/// Prints every key of settings files with default, range and meaning, as a Markdown table.
void printSettingsKeys();
