#pragma once
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hagen::observations {

/// Reads this many numbers, in blocks, so that a wrong number ends at the end of the file and does
/// not take all memory.
template <class Vector>
void readNumbers(mrpt::serialization::CArchive& in, std::size_t count, Vector& values) {
    constexpr std::size_t kBlock = 1 << 16;
    values.clear();
    while (values.size() < count) {
        const std::size_t before = values.size();
        const std::size_t more = std::min<std::size_t>(count - before, kBlock);
        values.resize(before + more);
        in.ReadBufferFixEndianness(values.data() + before, more);
    }
}

/// The name of a field.
inline std::string readName(mrpt::serialization::CArchive& in) {
    constexpr std::uint32_t kMostLetters = 256;
    const auto letters = in.ReadAs<std::uint32_t>();
    if (letters > kMostLetters) throw std::runtime_error("the name of a field is too long");
    std::string name;
    readNumbers(in, letters, name);
    return name;
}

/// As long as it lives, what is printed on standard error goes nowhere.
class StandardErrorAside {
 public:
    StandardErrorAside() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
    ~StandardErrorAside() { std::cerr.rdbuf(before_); }
    StandardErrorAside(const StandardErrorAside&) = delete;
    StandardErrorAside& operator=(const StandardErrorAside&) = delete;

 private:
    std::ostringstream text_;
    std::streambuf* before_;
};

/// Registers a class under the name of another. The entries live as long as the program.
template <class Derived, class Base>
void registerAs(const char* name) {
    static const mrpt::rtti::TRuntimeClassId id{
        name,
        [] { return std::static_pointer_cast<mrpt::rtti::CObject>(std::make_shared<Derived>()); },
        [] { return CLASS_ID(Base); }};
    // MRPT warns on standard error if the name is taken.
    const StandardErrorAside aside;
    mrpt::rtti::registerClassCustomName(name, &id);
}

}  // namespace hagen::observations
