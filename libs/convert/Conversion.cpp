#include <hagen/base/OutputPath.h>
#include <hagen/convert/Conversion.h>

#include <mrpt/img/CImage.h>
#include <mrpt/io/lazy_load_path.h>

#include "convert/Converter.h"

namespace hagen::convert {
namespace {

namespace fs = std::filesystem;

/// MRPT's folder for data in external files: "flight_Images" next to "flight.rawlog".
fs::path externalsOf(const fs::path& rawlog) {
    fs::path folder = fs::absolute(rawlog);
    folder.replace_extension();
    folder += "_Images";
    return folder;
}

/// Tells MRPT where the input's external files are, and the user where the output expects them.
void useExternals(const Conversion& conversion, const ConversionListener& listener) {
    const fs::path folder = externalsOf(conversion.input);
    std::error_code no_such;  // a name with the ending may be too long
    if (fs::is_directory(conversion.input) || !fs::is_directory(folder, no_such)) return;
    mrpt::io::setLazyLoadPathBase(folder.string() + "/");
    mrpt::img::CImage::setImagesPathBase(folder.string() + "/");
    if (conversion.rawlog.empty() || externalsOf(conversion.rawlog) == folder) return;
    listener.remark("the log", "stores data in files in " + folder.string() +
                                   "; link or copy that folder as " +
                                   externalsOf(conversion.rawlog).string());
}

}  // namespace

ConversionReport convert(const Conversion& conversion, const ConversionListener& listener) {
    if (!fs::exists(conversion.input)) {
        throw std::runtime_error(conversion.input.string() + ": no such file or folder");
    }
    std::vector<fs::path> outputs = conversion.octomaps;
    outputs.insert(outputs.end(), {conversion.rawlog, conversion.folder, conversion.clouds,
                                   conversion.mcap, conversion.pictures, conversion.stats});
    std::vector<fs::path> inputs = conversion.settings.files;
    inputs.insert(inputs.end(), {conversion.input, conversion.poses, conversion.sensor_json,
                                 conversion.calibration});
    const fs::path externals = externalsOf(conversion.input);
    std::error_code no_such;
    if (fs::is_directory(externals, no_such)) inputs.push_back(externals);
    base::checkApart(outputs, inputs);
    useExternals(conversion, listener);
    return Converter(conversion, listener).run();
}

}  // namespace hagen::convert
