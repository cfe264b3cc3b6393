#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace hagen::python {

/// Text from a recording, or with a path in it, which may have bytes that are no UTF-8: each
/// becomes U+FFFD. Python's own conversion would raise.
pybind11::str shownText(const std::string& text);
pybind11::list shownTexts(const std::vector<std::string>& texts);

/// The name of a file for Python: os.fsencode() returns its bytes.
pybind11::str fileText(const std::string& name);

/// The result of str() for an object. Surrogates, for which UTF-8 has no bytes, are escaped.
std::string textOf(const pybind11::handle& object);

/// From here on, exceptions whose text is no UTF-8 keep their type, and have it as by shownText().
void showErrorTexts();

}  // namespace hagen::python
