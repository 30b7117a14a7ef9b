//! Random numbers in bulk: the same on every machine, and of no quality to speak of.

use glam::{DQuat, Vec3};

/// SplitMix64 (Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The stream of that number.
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// One of these.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// From 0 to 1, with 53 random bits.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// From −1 to 1.
    pub fn signed(&mut self) -> f32 {
        (2.0 * self.unit() - 1.0) as f32
    }

    /// A power of two with an exponent from `low` to `high`, times 1 to 2, of either sign.
    pub fn magnitude(&mut self, low: i32, high: i32) -> f32 {
        let exponent = low + self.below((high - low + 1) as usize) as i32;
        let sign = if self.bits() & 1 == 0 { 1.0 } else { -1.0 };
        sign * (1.0 + self.unit() as f32) * power(exponent)
    }

    /// A point of the cube from −1 to 1.
    pub fn in_cube(&mut self) -> Vec3 {
        Vec3::new(self.signed(), self.signed(), self.signed())
    }

    /// A point of the ball of radius 1, not its centre.
    pub fn in_ball(&mut self) -> Vec3 {
        loop {
            let point = self.in_cube();
            if (1e-6..=1.0).contains(&point.length_squared()) {
                return point;
            }
        }
    }

    /// A rotation, any as likely as any other.
    pub fn rotation(&mut self) -> DQuat {
        loop {
            let [x, y, z, w] = [(); 4].map(|()| 2.0 * self.unit() - 1.0);
            let quat = DQuat::from_xyzw(x, y, z, w);
            if (1e-6..=1.0).contains(&quat.length_squared()) {
                return quat.normalize();
            }
        }
    }

    /// A unit vector.
    pub fn direction(&mut self) -> Vec3 {
        self.in_ball().normalize()
    }
}

/// 2^`exponent`, for the exponents of normal numbers.
pub fn power(exponent: i32) -> f32 {
    assert!((-126..=127).contains(&exponent), "2^{exponent} is no normal f32");
    f32::from_bits(((exponent + 127) as u32) << 23)
}
