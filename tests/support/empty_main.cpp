// SPDX-License-Identifier: MIT
//
// A program of nothing: it holds the header that the tests share, compiled once.
int main() {}
