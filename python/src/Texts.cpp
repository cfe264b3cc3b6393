#include "Texts.h"

#include <hagen/settings/Settings.h>

#include <exception>
#include <stdexcept>

namespace hagen::python {

namespace py = pybind11;

namespace {

py::str made(PyObject* text) {
    if (text == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(text);
}

/// Throws a copy of `error` with a text for Python, or `error` itself if its text is valid.
template <class Error>
[[noreturn]] void rethrowShown(const std::exception& error) {
    const auto shown = shownText(error.what()).cast<std::string>();
    if (shown == error.what()) throw;
    throw Error(shown);
}

/// Rethrows exceptions with valid texts for the previous translators.
void showErrorText(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(std::move(thrown));
    } catch (const py::error_already_set&) {
        throw;
    } catch (const py::builtin_exception&) {
        throw;
    } catch (const SettingsError& error) {
        rethrowShown<SettingsError>(error);
    } catch (const std::invalid_argument& error) {
        rethrowShown<std::invalid_argument>(error);
    } catch (const std::exception& error) {
        rethrowShown<std::runtime_error>(error);
    }
}

}  // namespace

py::str shownText(const std::string& text) {
    return made(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

py::list shownTexts(const std::vector<std::string>& texts) {
    py::list shown;
    for (const std::string& text : texts) shown.append(shownText(text));
    return shown;
}

py::str fileText(const std::string& name) {
    return made(
        PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<py::ssize_t>(name.size())));
}

std::string textOf(const py::handle& object) {
    return py::str(object).attr("encode")("utf-8", "backslashreplace").cast<std::string>();
}

void showErrorTexts() { py::register_exception_translator(&showErrorText); }

}  // namespace hagen::python
