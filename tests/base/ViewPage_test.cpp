// Data and page of the viewer.
#include <gmock/gmock.h>

#include <sstream>

#include "base/view/ViewPage.h"
#include "support/ReadView.h"

namespace hagen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(ViewArrays, KeepsIntegersAndWrappedDifferences) {
    base::ViewArrays arrays;
    arrays.add("bytes", std::vector<std::uint8_t>{0, 255, 1});
    arrays.add("signed", std::vector<std::int16_t>{-32768, 32767, -1}, true);
    arrays.add("wide", std::vector<std::int32_t>{-1, 70000, 5}, true);
    arrays.add("none", std::vector<std::uint16_t>{});
    auto read = test::viewArrays(arrays.json());
    EXPECT_THAT(read["bytes"], ElementsAre(0, 255, 1));
    EXPECT_THAT(read["signed"], ElementsAre(-32768, 32767, -1));
    EXPECT_THAT(read["wide"], ElementsAre(-1, 70000, 5));
    EXPECT_THAT(read["none"], ElementsAre());
}

TEST(ViewReturns, AzimuthsAreRelativeToColumns) {
    base::ViewReturns returns;
    returns.rows = 2;
    returns.columns = 4;
    // Column 1 is centred at 45 degrees; the second return is half a column further left.
    returns.azimuth_rad = {0.7853982f, 1.5707963f, -0.7853982f};
    returns.elevation_rad = {0, 0.001f, 0};
    returns.range_m = {1, 2, 3};
    returns.label = {2, 1, 2};
    returns.obstacle = {7, 0, 8};
    returns.pixel = {2, 3, -1};
    base::ViewArrays arrays;
    addReturns(returns, arrays);
    auto read = test::viewArrays(arrays.json());
    EXPECT_THAT(read["offset"], ElementsAre(128, 132));
    EXPECT_THAT(read["azimuth"], ElementsAre(65536 - 2048));
    EXPECT_THAT(read["elevation"], ElementsAre(0, 2, 0));
    EXPECT_THAT(read["range"], ElementsAre(25, 50, 75));
    EXPECT_THAT(read["obstacle"], ElementsAre(7, 8));  // of RoI returns only
}

TEST(ViewPage, EscapesTexts) {
    std::ostringstream page;
    base::writeViewPage(page, {{"heading", "a & </script>"}}, {"{\"name\":\"</script>\"}"});
    EXPECT_THAT(page.str(), HasSubstr("<title>a &amp; &lt;/script></title>"));
    const auto data = test::viewData(page.str());
    EXPECT_EQ(data["heading"], "a & </script>");
    EXPECT_EQ(data["frames"][0]["name"], "</script>");
    EXPECT_THAT(page.str(), Not(HasSubstr("{{")));
}

}  // namespace
}  // namespace hagen
