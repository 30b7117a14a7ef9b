//! The levels of this CPU, weakest first, one a line.
#![allow(clippy::print_stdout, reason = "a program that prints")]

use simd4::Level;

fn main() {
    for level in Level::available() {
        println!("{level}");
    }
}
