#pragma once
// A stub of the class in version 3.
#include <mrpt/maps/CSimplePointsMap.h>

namespace mrpt::maps {
class CGenericPointsMap : public CSimplePointsMap {
 public:
    bool registerField_float(const std::string& name);
    void setPointField_float(std::size_t i, const std::string& name, float value);
};
}  // namespace mrpt::maps
