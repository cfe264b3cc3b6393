#pragma once
#include <hagen/scan/Image.h>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>
#include "base/Json.h"

namespace hagen::convert {

/// A job for draw.py, which draws with matplotlib: parameters, and arrays of numbers. draw.py
/// documents the parameters of each kind of picture.
class Drawing {
 public:
    explicit Drawing(base::Json parameters) : parameters_(std::move(parameters)) {}

    /// Adds an image, which Python gets as an array of columns.
    template <class T>
    void add(const std::string& name, const Image<T>& image) {
        add(name, image.data(),
            {static_cast<std::size_t>(image.cols()), static_cast<std::size_t>(image.rows())});
    }
    template <class T>
    void add(const std::string& name, const std::vector<T>& values) {
        add(name, values.data(), {values.size()});
    }
    /// Adds a row-major array.
    template <class T>
    void add(const std::string& name, const T* values, const std::vector<std::size_t>& shape) {
        const char kind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
        std::size_t bytes = sizeof(T);
        for (const std::size_t size : shape) bytes *= size;
        parameters_["arrays"][name] = {kind + std::to_string(sizeof(T)), shape};
        arrays_.append(reinterpret_cast<const char*>(values), bytes);
    }

    /// Draws with the one Python process of this program, which the first call starts. Replaces
    /// existing files. Throws std::runtime_error if python3 or matplotlib is missing (the message
    /// says which package to install), hangs, or cannot write a file (the message names it).
    void draw();

 private:
    base::Json parameters_;
    std::string arrays_;
};

/// The text of draw.py.
namespace texts {
extern const std::string_view draw_py;
}

}  // namespace hagen::convert
