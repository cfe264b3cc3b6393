#pragma once
// Common parts of the tests of conversion outputs.
#include <gtest/gtest.h>
#include <hagen/convert/Conversion.h>
#include <hagen/mrpt/ObservationScan.h>
#include "convert/RawlogWriter.h"

#include "support/Program.h"
#include "support/SimpleFirings.h"

namespace hagen::test {

/// A conversion for the sensor VLP-16, and the returns of its input, a scan of a pole.
class PoleConversion {
 protected:
    PoleConversion() {
        observations::readObservation(*poleScanFrom(0, "lidar"), {}, observed_);
        conversion_.settings.sensor.model = "VLP-16";
    }
    /// Converts the input and adds remarks to remarks_.
    convert::ConversionReport convertCounting() {
        convert::ConversionListener listener;
        listener.remark = [&](const std::string& what, const std::string& remark) {
            remarks_.push_back(what + ": " + remark);
        };
        return convert::convert(conversion_, listener);
    }
    std::filesystem::path writeRawlog(
        const std::vector<mrpt::obs::CObservation::Ptr>& scans) const {
        convert::RawlogWriter writer(folder_ / "in.rawlog", true);
        for (const auto& scan : scans) writer.write(*scan);
        writer.commit();
        return folder_ / "in.rawlog";
    }

    TemporaryFolder folder_;
    observations::ObservedScan observed_;
    convert::Conversion conversion_;
    std::vector<std::string> remarks_;
};

}  // namespace hagen::test
