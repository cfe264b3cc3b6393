#pragma once
#include <hagen/evaluation/Scores.h>
#include <pybind11/pybind11.h>

#include <string>
#include <typeinfo>

#include "Filter.h"
#include "PythonScan.h"
#include "Texts.h"

// Python objects without a C++ object: __new__() creates them, and __init__() of a derived class
// sees them before it calls the base's. With these, pybind11 would use uninitialized memory.
namespace pybind11::detail {

inline bool isEmpty(handle object, const std::type_info& held) {
    const type_info* const type = get_type_info(held);
    if (type == nullptr || !isinstance(object, reinterpret_cast<PyObject*>(type->type)))
        return false;
    auto* const of_python = reinterpret_cast<instance*>(object.ptr());
    return of_python->get_value_and_holder(type).value_ptr() == nullptr;
}

/// pybind11's caster, but raises TypeError for these objects.
template <class T>
class FilledCaster : public type_caster_base<T> {
 public:
    bool load(handle source, bool convert) {
        if (source && isEmpty(source, typeid(T))) {
            throw type_error(hagen::python::textOf(type::handle_of(source).attr("__name__")) +
                             ": the object is empty, because its constructor has not run");
        }
        return type_caster_base<T>::load(source, convert);
    }
};

template <>
class type_caster<hagen::python::PythonScan> : public FilledCaster<hagen::python::PythonScan> {};
template <>
class type_caster<hagen::python::Segmented> : public FilledCaster<hagen::python::Segmented> {};
template <>
class type_caster<hagen::python::Filter> : public FilledCaster<hagen::python::Filter> {};
template <>
class type_caster<hagen::evaluation::ClassScore>
    : public FilledCaster<hagen::evaluation::ClassScore> {};
template <>
class type_caster<hagen::evaluation::Scores> : public FilledCaster<hagen::evaluation::Scores> {};

}  // namespace pybind11::detail
