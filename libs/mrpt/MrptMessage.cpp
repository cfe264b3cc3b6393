#include <hagen/mrpt/MrptMessage.h>
#include "base/FileKind.h"

namespace hagen::observations {

std::string messageOf(const std::exception& exception) {
    std::string text = exception.what();
    // The innermost message comes last.
    const std::string mark = "Message: ";
    const std::size_t message = text.rfind(mark);
    if (message != std::string::npos) {
        const std::size_t start = text.find_first_not_of(' ', message + mark.size());
        if (start == std::string::npos) return "";
        text = text.substr(start, text.find('\n', start) - start);
    }
    // MRPT appends the messages of foreign exceptions without a mark.
    const std::string original = "Original exception:\n";
    const std::string whole = exception.what();
    const std::size_t inner = whole.rfind(original);
    if (inner != std::string::npos && inner > message) {
        const std::size_t start = inner + original.size();
        text = whole.substr(start, whole.find('\n', start) - start);
    }
    return base::isText(text) ? text : "";
}

}  // namespace hagen::observations
