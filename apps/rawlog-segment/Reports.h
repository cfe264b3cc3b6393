#pragma once
#include <hagen/logs/Conversion.h>

/// What a conversion found and wrote, on standard output.
void printSummary(const hagen::logs::Conversion& conversion,
                  const hagen::logs::ConversionReport& report);

/// Every key of settings files with default, range and meaning, as a Markdown table.
void printSettingsKeys();
