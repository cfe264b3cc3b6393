// Like tests.h, for tests that use MRPT.
#pragma once
#include "mrpt.h"
//
#include <gmock/gmock.h>
#include <gtest/gtest.h>
