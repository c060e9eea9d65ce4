// The tables of the benchmark; docs/bench.md tells what each means.
#pragma once

#include "harness.h"
#include "report.h"

namespace elastoon {

void runDistanceTables(const Choice& choice, Report& report);
void runTouchTable(const Choice& choice, Report& report);
void runSupportTable(const Choice& choice, Report& report);
void runHullTable(const Choice& choice, Report& report);
void runWorldTable(const Choice& choice, Report& report);
void runScaleTable(const Choice& choice, Report& report);
void runRollbackTable(const Choice& choice, Report& report);

} // namespace elastoon
