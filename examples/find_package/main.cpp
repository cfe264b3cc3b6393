#include <hagen/observations/ObservationSegmenter.h>

#include <cstdio>

int main() {
    hagen::registerHagenClasses();
    const auto segmenter = mrpt::rtti::classFactory("hagen::ObservationSegmenter");
    std::printf("%s\n", segmenter ? segmenter->GetRuntimeClass()->className : "not found");
    return segmenter ? 0 : 1;
}
