//! Numbers of 106 bits that know how far off they may be.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number known to be within `error` of `high + low`.
///
/// The sum is a double-double; its operations are off by at most ten units of 2^-106 (Joldes,
/// Muller, Popescu, "Tight and Rigorous Error Bounds for Basic Building Blocks of Double-Word
/// Arithmetic", 2017), for which twice as much is taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    high: f64,
    low: f64,
    error: f64,
}

/// What one operation is off by, relative to its result.
const OFF: f64 = 20.0 * ROUNDOFF * ROUNDOFF;
const ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// Errors are sums and products of a few roundings themselves.
const MORE: f64 = 1.0 + 1e-9;

/// A sum and what was lost of it (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_b = sum - a;
    (sum, (a - (sum - from_b)) + (b - from_b))
}

/// The same, for |a| >= |b| (Dekker).
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

impl Ball {
    /// An exact number.
    pub(super) fn new(number: f32) -> Ball {
        Ball { high: number.into(), low: 0.0, error: 0.0 }
    }

    /// With what one operation and its operands are off by.
    fn rounded((high, low): (f64, f64), operands: f64) -> Ball {
        // Below 2^-900 parts may have vanished.
        let vanished = if high.abs() < 1e-270 && high != 0.0 { 1e-270 } else { 0.0 };
        Ball { high, low, error: (operands + OFF * high.abs() + vanished) * MORE }
    }

    /// The nearest `f64`.
    pub(super) fn value(self) -> f64 {
        self.high
    }

    /// How far off the value may be.
    pub(super) fn error(self) -> f64 {
        self.error + ROUNDOFF * self.high.abs()
    }

    /// Whether it is less than, equal to or greater than zero: `None` if that is too close to call.
    pub(super) fn sign(self) -> Option<Ordering> {
        if self.high == 0.0 && self.error == 0.0 {
            Some(Ordering::Equal)
        } else if self.high.abs() > self.error * MORE {
            self.high.partial_cmp(&0.0)
        } else {
            None
        }
    }

    /// The square root; 0 or more is taken for granted.
    pub(super) fn sqrt(self) -> Ball {
        let high = self.high.max(0.0).sqrt();
        if high == 0.0 {
            return Ball { high: 0.0, low: 0.0, error: self.error.sqrt() };
        }
        let rest = high.mul_add(-high, self.high) + self.low;
        let root = fast_two_sum(high, rest / (2.0 * high));
        // |√x − √y| <= |x − y| / √x.
        Ball::rounded(root, self.error / high)
    }
}

impl Add for Ball {
    type Output = Ball;
    fn add(self, other: Ball) -> Ball {
        let (high, high_lost) = two_sum(self.high, other.high);
        let (low, low_lost) = two_sum(self.low, other.low);
        let (high, lost) = fast_two_sum(high, high_lost + low);
        Ball::rounded(fast_two_sum(high, low_lost + lost), self.error + other.error)
    }
}

impl Neg for Ball {
    type Output = Ball;
    fn neg(self) -> Ball {
        Ball { high: -self.high, low: -self.low, error: self.error }
    }
}

impl Sub for Ball {
    type Output = Ball;
    fn sub(self, other: Ball) -> Ball {
        self + -other
    }
}

impl Mul for Ball {
    type Output = Ball;
    fn mul(self, other: Ball) -> Ball {
        let high = self.high * other.high;
        let lost = self.high.mul_add(other.high, -high);
        let low = self.low.mul_add(other.high, self.high * other.low) + self.low * other.low;
        let operands = self.high.abs() * other.error
            + other.high.abs() * self.error
            + self.error * other.error;
        Ball::rounded(fast_two_sum(high, lost + low), operands)
    }
}

impl Div for Ball {
    type Output = Ball;
    /// The divisor is not within its error of 0.
    fn div(self, other: Ball) -> Ball {
        let high = self.high / other.high;
        let times = Ball { high, low: 0.0, error: 0.0 } * Ball { error: 0.0, ..other };
        let rest = Ball { error: 0.0, ..self } - times;
        let quotient = fast_two_sum(high, (rest.high + rest.low) / other.high);
        let least = other.high.abs() - other.error;
        Ball::rounded(quotient, (self.error + high.abs() * other.error) / least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integers of 106 bits, so that all is known exactly.
    fn of(mut integer: i128) -> Ball {
        let mut sum = Ball::new(0.0);
        let mut weight = 1.0;
        while integer != 0 {
            let digit = Ball::new((integer % (1 << 20)) as f32);
            sum = sum + digit * Ball::new(weight);
            integer /= 1 << 20;
            weight *= (1 << 20) as f32;
        }
        sum
    }

    /// Whether the ball holds it, and is no wider than what numbers of that size call for.
    fn holds(ball: Ball, integer: i128, size: i128) -> bool {
        let off = (ball.high as i128 - integer) as f64 + ball.low;
        off.abs() <= ball.error && ball.error <= 1e-29 * size.abs() as f64
    }

    #[test]
    fn integers_come_out() {
        let mut seed = 1u64;
        let mut next = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            i128::from(seed as i64 >> 12)
        };
        for _ in 0..10_000 {
            let (a, b) = (next(), next());
            assert!(holds(of(a) + of(b), a + b, 1 << 52), "{a} + {b}");
            assert!(holds(of(a) - of(b), a - b, 1 << 52), "{a} - {b}");
            assert!(holds(of(a) * of(b), a * b, a * b), "{a} * {b}");
            assert!(holds(of(a * b) / of(b), a, a), "{a} * {b} / {b}");
            assert!(holds((of(a) * of(a)).sqrt(), a.abs(), a), "√{a}²");
        }
    }

    #[test]
    fn signs_are_right_or_not_told() {
        let third = Ball::new(1.0) / Ball::new(3.0);
        assert_eq!((third + third + third - Ball::new(1.0)).sign(), None);
        assert_eq!((Ball::new(0.5) - Ball::new(0.5)).sign(), Some(Ordering::Equal));
        assert_eq!((third - Ball::new(1.0 / 3.0)).sign(), Some(Ordering::Less));
        assert_eq!((Ball::new(1e-45) - Ball::new(1e30)).sign(), Some(Ordering::Less));
        let tiny = Ball::new(1e-45);
        assert_ne!(
            (tiny * tiny * tiny * tiny * tiny * tiny * tiny * tiny).sign(),
            Some(Ordering::Equal)
        );
    }
}
