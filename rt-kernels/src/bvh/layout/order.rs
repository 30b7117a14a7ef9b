//! In which order rays come by the children of a node: a guess, on which no answer depends.
//!
//! Children stand in halves of four lanes. Rays that go one way come by one half first, those that go the
//! other way by the other, and in each half by its lanes in one of 24 orders. So whoever has four lanes puts
//! the children in order half by half, by a table that knows, too, which of them are wanted; whoever has a
//! lane for each of eight finds one order of all.
//!
//! Orders are from the last to the first, as a stack wants them.

use simd4::{Lanes, SimdF32, SimdInt};

/// The lanes of a half.
const HALF: usize = 4;

/// The octants of directions; the others are opposite to these.
const OCTANTS: usize = 4;

/// The order of N children for rays of each octant.
///
/// In word i, first the lane that is i-th of eight, three bits for each octant, the first octant lowest. Above
/// them, in the upper 8 bits of all words, what is known of halves: for each of four octants, and of each half,
/// the number of the order of its lanes ([`ORDERS`]), and whether the upper half is the last
/// ([`UPPER_LAST`]). Rays of the opposite octant come by everything the other way round.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order<const N: usize>([u32; N]);

/// Where the upper 8 bits begin.
const UPPER: u32 = 24;

/// Among the upper 8 bits.
const UPPER_LAST: u32 = 1 << 5;

impl<const N: usize> Order<N> {
    /// Any order.
    pub(super) const ANY: Self = Order([0; N]);

    /// Guesses by the centres of the children's boxes, by axis. What is NaN is not there.
    pub(super) fn of(centers: &[[f32; N]; 3]) -> Self {
        // How far along the diagonals of the octants they are.
        let along: [[f32; OCTANTS]; N] = std::array::from_fn(|lane| {
            let [x, y, z] = centers.each_ref().map(|center| center[lane]);
            [x + y + z, y - x + z, x - y + z, z - x - y]
        });
        let (halves, _) = along.as_chunks::<HALF>();
        let mut words = [0; N];
        for octant in 0..OCTANTS {
            let means = halves.iter().map(|half| mean(half.map(|lane| lane[octant])));
            let last = usize::from(means.is_sorted_by(|lower, upper| upper > lower));
            let upper_last = UPPER_LAST * last as u32;
            for (i, half) in halves.iter().enumerate() {
                let number = number(half.map(|lane| lane[octant]));
                words[octant * halves.len() + i] |= (number as u32 | upper_last) << UPPER;
                if N == HALF {
                    continue;
                }
                // The last one way is the first the other way.
                let ways = [(octant, number, i ^ last), (7 - octant, number ^ 1, i ^ last ^ 1)];
                for (octant, number, at) in ways {
                    let words = words[at * HALF..][..HALF].iter_mut();
                    for (word, lane) in words.zip(ORDERS[number]) {
                        *word |= (lane + (i * HALF) as u32) << (3 * octant);
                    }
                }
            }
        }
        Order(words)
    }

    /// The order of all eight lanes.
    #[inline(always)]
    pub(super) fn of_eight<V: SimdF32>(&self, s: V::Simd, octant: u32) -> V::U32 {
        V::U32::load(s, &self.0).shr(3 * octant)
    }

    /// The halves, 0 and 1, for rays of an octant, the last first.
    #[inline(always)]
    pub(super) fn halves(&self, octant: u32) -> [Half; 2] {
        let back = octant >> 2 & 1;
        let first = (octant ^ (7 * back)) as usize % OCTANTS * (N / HALF);
        let back = (UPPER_LAST | 1) * back;
        let of = |half: usize| (self.0[(first + half) % N] >> UPPER) ^ back;
        let last = if N > HALF { (of(0) / UPPER_LAST) as usize & 1 } else { 0 };
        [last, last ^ 1].map(|half| Half { half, number: of(half) as usize % ROOM })
    }
}

/// Of those that are not NaN.
fn mean(lanes: [f32; HALF]) -> f32 {
    let there = lanes.iter().filter(|lane| !lane.is_nan());
    there.clone().sum::<f32>() / there.count() as f32
}

/// The number of the order from the greatest to the least.
fn number(lanes: [f32; HALF]) -> usize {
    let bits = PAIRS.map(|(a, b)| usize::from(lanes[a] > lanes[b]));
    NUMBERS[bits.into_iter().rev().fold(0, |bits, bit| bits << 1 | bit)].into()
}

/// Four lanes, and their order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Half {
    /// The lower or the upper.
    pub(super) half: usize,
    number: usize,
}

impl Half {
    /// The order of those lanes that are in a mask, without gaps, and how many they are.
    #[inline(always)]
    pub(super) fn order<V: SimdF32>(&self, s: V::Simd, lanes: u32) -> (V::U32, usize) {
        let lanes = lanes as usize % (1 << HALF);
        (V::U32::load(s, &CHOSEN[self.number % ROOM][lanes]), COUNTS[lanes].into())
    }
}

/// The order that puts these lanes, of eight or of four, first, and how many they are. (`compress_store` would
/// keep what is behind them in memory; here it is of no account, and to write all lanes is quicker.)
#[inline(always)]
pub(crate) fn without_gaps<V: SimdF32>(s: V::Simd, lanes: u32) -> (V::U32, usize) {
    let lanes = lanes as usize % COMPRESSED.len();
    (V::U32::load(s, &COMPRESSED[lanes]), COUNTS[lanes].into())
}

/// Those lanes of an order that are in a mask, without gaps, and after them the first lane again.
const fn pick<const L: usize>(order: [u32; L], mask: usize) -> [u32; L] {
    let (mut picked, mut count, mut i) = ([0; L], 0, 0);
    while i < L {
        if mask >> order[i] & 1 == 1 {
            picked[count] = order[i];
            count += 1;
        }
        i += 1;
    }
    picked
}

/// Of each mask of eight lanes, or of four, the lanes.
static COMPRESSED: [[u32; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        table[mask] = pick([0, 1, 2, 3, 4, 5, 6, 7], mask);
        mask += 1;
    }
    table
};

/// How many lanes each mask has: not every level has an instruction for it.
static COUNTS: [u8; 256] = {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        table[mask] = (mask as u32).count_ones() as u8;
        mask += 1;
    }
    table
};

/// So many numbers of orders have room: the next power of two.
const ROOM: usize = 32;

/// The 24 orders of four lanes. The other way round a number's last bit is the other.
static ORDERS: [[u32; HALF]; ROOM] = {
    let mut orders = [[0; HALF]; ROOM];
    let (mut code, mut count) = (0, 0);
    while code < 256 {
        let [a, b, c, d] = [code >> 6, code >> 4 & 3, code >> 2 & 3, code & 3];
        let all_four = 1 << a | 1 << b | 1 << c | 1 << d == 0b1111;
        if all_four && a < d {
            orders[count] = [a, b, c, d];
            orders[count + 1] = [d, c, b, a];
            count += 2;
        }
        code += 1;
    }
    assert!(count == 24);
    orders
};

/// What has to be compared to know the order of four lanes.
const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

/// By a bit for each of [`PAIRS`], whether its first comes before its second, the number of the order.
static NUMBERS: [u8; 64] = {
    let mut numbers = [0; 64];
    let mut number = 0;
    while number < 24 {
        let mut place = [0; HALF];
        let mut i = 0;
        while i < HALF {
            place[ORDERS[number][i] as usize] = i;
            i += 1;
        }
        let (mut bits, mut pair) = (0, 0);
        while pair < PAIRS.len() {
            let (a, b) = PAIRS[pair];
            bits |= ((place[a] < place[b]) as usize) << pair;
            pair += 1;
        }
        numbers[bits] = number as u8;
        number += 1;
    }
    numbers
};

/// Of each order of four lanes, and of each mask, the mask's lanes in that order.
static CHOSEN: [[[u32; HALF]; 1 << HALF]; ROOM] = {
    let mut table = [[[0; HALF]; 1 << HALF]; ROOM];
    let mut number = 0;
    while number < 24 {
        let mut mask = 0;
        while mask < 1 << HALF {
            table[number][mask] = pick(ORDERS[number], mask);
            mask += 1;
        }
        number += 1;
    }
    table
};
