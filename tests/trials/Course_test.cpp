#include <gtest/gtest.h>
#include <hagen/trials/Course.h>
namespace hagen {
namespace {
TEST(CourseTest, X) {
    for (const auto& name : courseNames()) makeCourse(name, 1);
}
}
}
