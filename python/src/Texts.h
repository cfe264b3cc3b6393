#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace hagen::python {

/// Converts a text from a recording, or with a path. Invalid UTF-8 bytes, for which Python's
/// conversion would raise, become U+FFFD.
pybind11::str shownText(const std::string& text);
pybind11::list shownTexts(const std::vector<std::string>& texts);

/// Converts a file name so that os.fsencode() returns its bytes.
pybind11::str fileText(const std::string& name);

/// The result of str() for an object. Surrogates, which UTF-8 cannot encode, are escaped.
std::string textOf(const pybind11::handle& object);

/// Registers a translator: exceptions with invalid UTF-8 keep their type and get a text from
/// shownText().
void showErrorTexts();

}  // namespace hagen::python
