// SPDX-License-Identifier: BSD-3-Clause
// Texts of messages, and numbers in texts.
#include "Core/Messages/MessageText.h"
#include "Core/Messages/NotFiniteValues.h"
#include "Core/Messages/NumberText.h"
#include "Core/Messages/PartText.h"
#include "Core/Parallel/MemoryPlan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace RectifiedTransport
{
namespace
{

TEST(Texts, AreUtf8)
{
  EXPECT_EQ(messageText("Dichte \xC3\xBC"), "Dichte \xC3\xBC");
  EXPECT_EQ(messageText("Dichte \xFC"), "Dichte \xC3\xBC");
  // A surrogate, a longer form than needed, and a character that ends too early.
  EXPECT_EQ(messageText("\xED\xA0\x80"), "\xC3\xAD\xC2\xA0\xC2\x80");
  EXPECT_EQ(messageText("\xC0\x80"), "\xC3\x80\xC2\x80");
  EXPECT_EQ(messageText("\xE2\x82"), "\xC3\xA2\xC2\x82");
  EXPECT_EQ(messageText("\xF0\x9F\x98\x80!"), "\xF0\x9F\x98\x80!");
}

TEST(Texts, MayBeNumbers)
{
  EXPECT_EQ(parseNumber(" +1.5\n"), 1.5);
  EXPECT_EQ(parseNumber("-3e2"), -300.0);
  EXPECT_EQ(parseNumber("1e400"), HUGE_VAL);
  EXPECT_EQ(parseNumber("1e-400"), 0.0);
  EXPECT_TRUE(std::isnan(parseNumber("nan").value()));
  for (const char* const text : { "", " ", "+-1", "1,5", "1 2", "n/a" })
  {
    EXPECT_EQ(parseNumber(text), std::nullopt) << text;
  }
  EXPECT_TRUE(isBlank(" \t"));
  EXPECT_FALSE(isBlank(" 0"));
  EXPECT_EQ(shortened(std::string(41, 'a')), std::string(40, 'a') + "...");
}

TEST(Texts, SayWhichPart)
{
  EXPECT_EQ(percentText(0.0041), "0.41 %");
  EXPECT_EQ(percentText(8.1), "810 %");
  EXPECT_EQ(describePart(12, 8192, "cells"), "12 of 8192 cells (0.146 %)");
  EXPECT_FALSE(isWorthWarning<std::int64_t>(0, 0));
  EXPECT_FALSE(isWorthWarning<std::int64_t>(1, 1001));
  EXPECT_TRUE(isWorthWarning<std::int64_t>(1, 1000));
  EXPECT_TRUE(isWorthWarning(0.5, 2.0));
}

TEST(Texts, CountValuesThatAreNotFinite)
{
  NotFiniteValues all;
  all.Add(NotFiniteValues());
  NotFiniteValues later;
  later.Add(7);
  all.Add(later);
  EXPECT_EQ(all.Text("point"), "has 1 point that is NaN or infinite, the first at index 7");
  later.Add(9);
  all.Add(later);
  EXPECT_EQ(all.Text("point"), "has 3 points that are NaN or infinite, the first at index 7");
}

TEST(Texts, SayWhichMemoryIsMissing)
{
  const MemoryPlan plan{ "tables", 2.5e9 };
  EXPECT_EQ(plan.DescribeLack(), "Not enough memory for tables: 2.5 GB were asked for");
  EXPECT_FALSE((MemoryPlan{ "tables", 1e30 }).Fits());
  EXPECT_TRUE((MemoryPlan{ "tables", 1e3 }).Fits());
}

} // namespace
} // namespace RectifiedTransport
