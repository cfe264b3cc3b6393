#pragma once
#include <hagen/scan/Image.h>

#include <random>

namespace hagen::test {

/// Random test data from the test's seed, so that failures are reproducible.
class Random {
 public:
    explicit Random(unsigned seed) : engine_(seed) {}

    float real(float min, float max) {
        return std::uniform_real_distribution<float>(min, max)(engine_);
    }
    int whole(int min, int max) { return std::uniform_int_distribution<int>(min, max)(engine_); }
    bool chance(double probability) { return std::bernoulli_distribution(probability)(engine_); }

    /// An image with values in [min, max] and a share of missing values.
    Image<float> image(int rows, int columns, float min, float max, double missing) {
        Image<float> image(rows, columns);
        for (float& pixel : image.reshaped()) {
            pixel = chance(missing) ? kNoValue : real(min, max);
        }
        return image;
    }

    std::mt19937& engine() { return engine_; }

 private:
    std::mt19937 engine_;
};

/// True if both images are equal, including empty pixels.
inline bool same(const Image<float>& a, const Image<float>& b) {
    return a.rows() == b.rows() && a.cols() == b.cols() &&
           ((a == b) || (a.isNaN() && b.isNaN())).all();
}

}  // namespace hagen::test
