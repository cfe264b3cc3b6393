#pragma once
#include <hagen/convert/Conversion.h>
#include "convert/LearnAirframe.h"

/// Prints the results and outputs of a conversion to standard output.
void printSummary(const hagen::convert::Conversion& conversion,
                  const hagen::convert::ConversionReport& report);

/// Prints the learned airframe, and a warning on standard error if it is implausibly large.
void printAirframe(const hagen::convert::AirframeLearning& learning,
                   const hagen::convert::AirframeReport& report);

/// Prints every key of settings files with default, range and meaning, as a Markdown table.
void printSettingsKeys();
