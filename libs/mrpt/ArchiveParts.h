#pragma once
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

namespace hagen::observations {

/// Reads `count` numbers in blocks, so that a corrupt count cannot exhaust memory.
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

inline std::string readText(mrpt::serialization::CArchive& in) {
    std::string text;
    readNumbers(in, in.ReadAs<std::uint32_t>(), text);
    return text;
}

/// Discards std::cerr during its lifetime.
class SilentErrorStream {
 public:
    SilentErrorStream() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
    ~SilentErrorStream() { std::cerr.rdbuf(before_); }
    SilentErrorStream(const SilentErrorStream&) = delete;
    SilentErrorStream& operator=(const SilentErrorStream&) = delete;

 private:
    std::ostringstream text_;
    std::streambuf* before_;
};

/// The description of a class for MRPT, under the same name in all calls.
template <class Derived, class Base>
const mrpt::rtti::TRuntimeClassId& classAs(const char* name) {
    static const mrpt::rtti::TRuntimeClassId id{
        name,
        [] { return std::static_pointer_cast<mrpt::rtti::CObject>(std::make_shared<Derived>()); },
        [] { return CLASS_ID(Base); }};
    return id;
}

/// Registers a class under another class's name.
template <class Derived, class Base>
void registerAs(const char* name) {
    // MRPT prints a warning to standard error if the name is taken.
    const SilentErrorStream silence;
    mrpt::rtti::registerClassCustomName(name, &classAs<Derived, Base>(name));
}

}  // namespace hagen::observations
