#include "tonemap/curves.h"

#include <gtest/gtest.h>

namespace tonetool::tonemap {
namespace {

TEST(Curves, AreFoundByName) {
    for (const std::string& name : curve_names())
        EXPECT_EQ(find_curve(name)->name, name);
}

} // namespace
} // namespace tonetool::tonemap
