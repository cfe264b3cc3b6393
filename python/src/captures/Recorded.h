#pragma once
#include <hagen/scan/Scan.h>

#include "PythonScan.h"

namespace hagen::python {

struct Recorded {
    Scan returns;
};

}  // namespace hagen::python
