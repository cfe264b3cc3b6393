#pragma once
#include <ios>
#include <locale>
#include <sstream>

namespace hagen::base {

/// A locale-independent std::ostringstream that throws std::bad_alloc when memory runs out instead
/// of truncating the text.
class TextStream : public std::ostringstream {
 public:
    TextStream() {
        imbue(std::locale::classic());
        exceptions(std::ios::badbit);
    }
};

}  // namespace hagen::base
