//! What every benched function reads and writes: rows of numbers in the first-level cache.

/// Elements of a row: three rows and the output of one op fit in 32 KiB.
pub(crate) const N: usize = 2048;

/// A row on a boundary that no register straddles, and a few lines long of a power of two: rows
/// whose addresses agree in their low bits would wait for each other.
#[repr(C, align(64))]
#[derive(Clone)]
pub(crate) struct Row<T, const LEN: usize>(pub(crate) [T; LEN], [[u32; 16]; 3]);

impl<T, const LEN: usize> Row<T, LEN> {
    fn new(mut element: impl FnMut() -> T) -> Self {
        Row(core::array::from_fn(|_| element()), [[0; 16]; 3])
    }
}

/// The rows. An op takes operands from the first ones of each kind.
#[derive(Clone)]
pub(crate) struct Io {
    pub(crate) f: [Row<f32, N>; 9],
    pub(crate) i: [Row<i32, N>; 2],
    pub(crate) u: [Row<u32, N>; 2],
    /// How far integers are shifted.
    pub(crate) shift: u32,
    /// What comes out, as bits or as floats.
    pub(crate) bits: Row<u32, { 2 * N }>,
    pub(crate) floats: Row<f32, { 2 * N }>,
}

impl Io {
    /// Numbers as programs have them, of both signs, between 2^-4 and 16.
    pub(crate) fn ordinary() -> Box<Io> {
        Self::of(|random| {
            let magnitude = f32::from_bits((123 << 23) + random % (8 << 23));
            if random >> 31 == 0 { magnitude } else { -magnitude }
        })
    }

    /// Where floating point changes its behaviour, half of it bits of any kind.
    pub(crate) fn special() -> Box<Io> {
        const SPECIAL: [f32; 16] = [
            0.0,
            -0.0,
            1.0,
            -1.5,
            0.5,
            -2.5,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::NAN,
            f32::MAX,
            -f32::MIN_POSITIVE,
            1e-45,
            8_388_607.5,
            2_147_483_600.0,
            -2_147_483_648.0,
            4_294_967_300.0,
        ];
        Self::of(|random| match random % 32 {
            special @ 0..16 => SPECIAL[special as usize],
            _ => f32::from_bits(random),
        })
    }

    fn of(float: impl Fn(u32) -> f32) -> Box<Io> {
        let mut random = xorshift();
        let mut floats = || Row::new(|| float(random()));
        let f = [(); 9].map(|()| floats());
        let mut random = xorshift();
        Box::new(Io {
            f,
            i: [(); 2].map(|()| Row::new(|| random() as i32)),
            u: [(); 2].map(|()| Row::new(&mut random)),
            shift: 5,
            bits: Row::new(|| 0),
            floats: Row::new(|| 0.0),
        })
    }

    /// The bits that a function leaves in cleared output.
    pub(crate) fn output(&mut self, run: impl FnOnce(&mut Io)) -> Vec<u32> {
        self.bits.0.fill(0);
        self.floats.0.fill(0.0);
        run(self);
        self.bits.0.iter().copied().chain(self.floats.0.iter().map(|x| x.to_bits())).collect()
    }
}

/// The first place where two outputs differ. Which NaN a NaN is does not matter.
pub(crate) fn difference(a: &[u32], b: &[u32]) -> Option<usize> {
    let is_nan = |bits: u32| f32::from_bits(bits).is_nan();
    a.iter().zip(b).position(|(&a, &b)| a != b && !(is_nan(a) && is_nan(b)))
}

/// Marsaglia's xorshift32.
fn xorshift() -> impl FnMut() -> u32 {
    let mut state = 0x9e37_79b9_u32;
    move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state
    }
}
