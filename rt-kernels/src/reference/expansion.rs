//! Exact sums (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates", 1997).

/// A sum of `f64`, exact: a list of parts that do not overlap.
#[derive(Default)]
pub(super) struct Expansion(Vec<f64>);

impl Expansion {
    /// Adds `a * b`.
    pub(super) fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(a.mul_add(b, -product));
        self.add(product);
    }

    /// Adds one number: Shewchuk's Grow-Expansion.
    pub(super) fn add(&mut self, number: f64) {
        let mut carry = number;
        self.0.retain_mut(|part| {
            let sum = carry + *part;
            let virtual_part = sum - carry;
            *part = (carry - (sum - virtual_part)) + (*part - virtual_part);
            carry = sum;
            *part != 0.0
        });
        if carry != 0.0 {
            self.0.push(carry);
        }
    }

    /// The nearest `f64`, or the next but one; 0 only if the sum is.
    pub(super) fn value(&self) -> f64 {
        self.0.iter().sum()
    }
}
