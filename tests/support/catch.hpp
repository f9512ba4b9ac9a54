#pragma once

// Catch2 as every test includes it.

#include <catch2/catch.hpp>

using Catch::Detail::Approx;
