#pragma once
#include <ios>
#include <locale>
#include <sstream>

namespace hagen::base {

/// A text that is written with <<, the same in every locale. If memory runs out it throws
/// std::bad_alloc; a plain std::ostringstream ends the text there, and says nothing.
class TextStream : public std::ostringstream {
 public:
    TextStream() {
        imbue(std::locale::classic());
        exceptions(std::ios::badbit);
    }
};

}  // namespace hagen::base
