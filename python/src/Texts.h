#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace hagen::python {

/// Converts a text from a recording, or with a path, whose invalid UTF-8 bytes become U+FFFD.
/// Python's own conversion would raise.
pybind11::str shownText(const std::string& text);
pybind11::list shownTexts(const std::vector<std::string>& texts);

/// A file name for Python: os.fsencode() returns its bytes.
pybind11::str fileText(const std::string& name);

/// The result of str() for an object. Surrogates, which UTF-8 cannot encode, are escaped.
std::string textOf(const pybind11::handle& object);

/// From here on, exceptions with invalid UTF-8 keep their type and get a text from shownText().
void showErrorTexts();

}  // namespace hagen::python
