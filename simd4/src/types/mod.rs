//! The types' contracts: what all numbers share ([`Lanes`]), what each kind of element adds, and
//! the pair of registers that makes a type of twice the width.

pub(crate) mod array;
mod f32;
mod halves;
mod int;
mod mask;
pub(crate) mod reduce;
mod seam;
#[allow(dead_code, reason = "which of them are needed depends on the architecture")]
pub(crate) mod soft;
mod swizzle;

pub use array::{Element, LaneArray};
pub use f32::SimdF32;
pub use halves::Halves;
pub(crate) use halves::Join;
pub use int::{SimdI32, SimdInt, SimdU32};
pub use mask::SimdMask;
pub use swizzle::Swizzle;

pub(crate) use seam::{conversions, operators, unary_operator};

use core::ops::{Add, AddAssign, Mul, MulAssign, Sub, SubAssign};

use crate::Simd;
use crate::simd::sealed::Sealed;
use crate::storage::Block;

/// Lanes of numbers: memory, arithmetic, comparisons, moves and reductions.
///
/// Lane 0 is the lowest address. Nothing here reads or writes past a slice.
pub trait Lanes:
    Copy
    + Send
    + Sync
    + core::fmt::Debug
    + Sealed
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
    + MulAssign
    + 'static
{
    /// The level's token.
    type Simd: Simd;
    /// One lane.
    type Elem: Element;
    /// All lanes, lane 0 first.
    type Array: LaneArray<Self::Elem>;
    /// The truth of a comparison, lane by lane.
    type Mask: SimdMask<Simd = Self::Simd>;

    /// The number of lanes.
    const LANES: usize;

    // Make

    /// The token that every value carries.
    fn token(self) -> Self::Simd;

    /// The same value in every lane.
    fn splat(s: Self::Simd, x: Self::Elem) -> Self;

    /// From an array, lane 0 first.
    fn from_array(s: Self::Simd, a: Self::Array) -> Self;

    /// To an array, lane 0 first.
    fn to_array(self) -> Self::Array;

    /// 0, 1, 2, … : every lane its own number.
    #[inline(always)]
    fn iota(s: Self::Simd) -> Self {
        Self::from_array(s, LaneArray::from_fn(Self::Elem::from_index))
    }

    /// The value of one lane.
    ///
    /// # Panics
    /// If there is no such lane.
    #[inline(always)]
    fn lane(self, lane: usize) -> Self::Elem {
        self.to_array().as_ref()[lane]
    }

    // Memory

    /// The first [`Lanes::LANES`] elements of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    #[inline(always)]
    fn load(s: Self::Simd, from: &[Self::Elem]) -> Self {
        match Self::Array::try_from(&from[..Self::LANES]) {
            Ok(a) => Self::from_array(s, a),
            Err(_) => unreachable!(),
        }
    }

    /// Writes the first [`Lanes::LANES`] elements of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    #[inline(always)]
    fn store(self, to: &mut [Self::Elem]) {
        to[..Self::LANES].copy_from_slice(self.to_array().as_ref());
    }

    /// The numbers of a block, which is aligned.
    #[inline(always)]
    fn load_aligned<B: Block<Elem = Self::Elem, Array = Self::Array>>(
        s: Self::Simd,
        from: &B,
    ) -> Self {
        Self::from_array(s, *from.array())
    }

    /// Writes a block, which is aligned.
    #[inline(always)]
    fn store_aligned<B: Block<Elem = Self::Elem, Array = Self::Array>>(self, to: &mut B) {
        *to.array_mut() = self.to_array();
    }

    /// The elements of a slice of any length, as many as there are lanes for; the lanes beyond
    /// get `fill`.
    #[inline(always)]
    fn load_prefix(s: Self::Simd, from: &[Self::Elem], fill: Self::Elem) -> Self {
        if from.len() >= Self::LANES {
            return Self::load(s, from);
        }
        let mut a = Self::splat(s, fill).to_array();
        let n = from.len();
        if Self::LANES > 4 && n > 3 {
            copy_prefix(from, a.as_mut());
        } else {
            // So that the lanes of one register need not go through memory.
            let last = if n & 1 == 1 { from[n - 1] } else { fill };
            let lanes = a.as_mut();
            if n & 2 == 2 {
                (lanes[0], lanes[1], lanes[2]) = (from[0], from[1], last);
            } else {
                lanes[0] = last;
            }
        }
        Self::from_array(s, a)
    }

    /// Writes as many lanes as a slice of any length takes.
    #[inline(always)]
    fn store_prefix(self, to: &mut [Self::Elem]) {
        let n = to.len();
        if n >= Self::LANES {
            return self.store(to);
        }
        let a = self.to_array();
        let lanes = a.as_ref();
        if Self::LANES > 4 && n > 3 {
            return copy_prefix(&lanes[..n], to);
        }
        if n & 2 == 2 {
            (to[0], to[1]) = (lanes[0], lanes[1]);
        }
        if n & 1 == 1 {
            to[n - 1] = lanes[n - 1];
        }
    }

    /// `mask ? from[lane] : fill`: only the elements of the mask's lanes are read.
    ///
    /// # Panics
    /// If the mask has a lane that the slice lacks.
    #[inline(always)]
    fn load_masked(s: Self::Simd, from: &[Self::Elem], mask: Self::Mask, fill: Self::Elem) -> Self {
        if from.len() >= Self::LANES {
            return Self::select(mask, Self::load(s, from), Self::splat(s, fill));
        }
        let bits = mask.bitmask();
        Self::from_array(
            s,
            LaneArray::from_fn(
                #[inline(always)]
                |i| if bits >> i & 1 == 1 { from[i] } else { fill },
            ),
        )
    }

    /// Writes the elements of the mask's lanes only.
    ///
    /// # Panics
    /// If the mask has a lane that the slice lacks.
    #[inline(always)]
    fn store_masked(self, to: &mut [Self::Elem], mask: Self::Mask) {
        if to.len() >= Self::LANES {
            return Self::merge(mask, self, Self::load(self.token(), to)).store(to);
        }
        let (a, bits) = (self.to_array(), mask.bitmask());
        let mut i = 0;
        while i < Self::LANES {
            if bits >> i & 1 == 1 {
                to[i] = a.as_ref()[i];
            }
            i += 1;
        }
    }

    /// `from[index]`, every lane at an index of its own.
    ///
    /// # Panics
    /// If an index is out of the slice.
    #[inline(always)]
    fn gather<I: SimdU32<Simd = Self::Simd, Mask = Self::Mask>>(
        from: &[Self::Elem],
        index: I,
    ) -> Self {
        Self::from_array(
            index.token(),
            LaneArray::from_fn(
                #[inline(always)]
                |i| from[index.index(i)],
            ),
        )
    }

    /// Writes the mask's lanes one after the other to the start of a slice and returns how many
    /// there are. The elements behind them keep their values.
    ///
    /// # Panics
    /// If the slice is shorter than that.
    #[inline(always)]
    fn compress_store(self, mask: Self::Mask, to: &mut [Self::Elem]) -> usize {
        let (a, bits) = (self.to_array(), mask.bitmask());
        let count = bits.count_ones() as usize;
        if to.len() <= Self::LANES {
            let to = &mut to[..count];
            let (mut i, mut n) = (0, 0);
            while n < count {
                if bits >> i & 1 == 1 {
                    to[n] = a.as_ref()[i];
                    n += 1;
                }
                i += 1;
            }
            return count;
        }
        // Without branches: every lane goes to where the mask's next one goes. What the last of
        // them leaves behind the end is put right.
        let to = &mut to[..=Self::LANES];
        let behind = to[count];
        let (mut i, mut n) = (0, 0);
        while i < Self::LANES {
            // It is not above i: this spares the check of bounds.
            to[n % Self::LANES] = a.as_ref()[i];
            n += (bits >> i & 1) as usize;
            i += 1;
        }
        to[count] = behind;
        count
    }

    // Least and greatest, comparisons

    /// [`spec::min`](crate::spec::min): `a < b ? a : b`, so a NaN in either gives `other`.
    fn min(self, other: Self) -> Self;
    /// [`spec::max`](crate::spec::max): `a > b ? a : b`, so a NaN in either gives `other`.
    fn max(self, other: Self) -> Self;

    /// `self == other`; false on NaN.
    fn eq(self, other: Self) -> Self::Mask;
    /// `self < other`; false on NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`; false on NaN.
    fn le(self, other: Self) -> Self::Mask;

    /// `self != other`; true on NaN.
    #[inline(always)]
    fn ne(self, other: Self) -> Self::Mask {
        !self.eq(other)
    }

    /// `self > other`; false on NaN.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }

    /// `self >= other`; false on NaN.
    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }

    /// `mask ? a : b`, lane by lane.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// The same, for storing where `b` was loaded.
    #[doc(hidden)]
    #[inline(always)]
    fn merge(mask: Self::Mask, a: Self, b: Self) -> Self {
        Self::select(mask, a, b)
    }

    /// `mask ? self : 0`, lane by lane.
    #[doc(hidden)]
    #[inline(always)]
    fn masked(self, mask: Self::Mask) -> Self {
        Self::select(mask, self, Self::splat(self.token(), Self::Elem::default()))
    }

    // Moves

    /// Lane `i` of the result is lane `I::INDEX[i]`; [`swizzle!`](crate::swizzle!) takes the
    /// order in place.
    #[inline(always)]
    fn swizzle<I: Swizzle>(self) -> Self {
        const { swizzle::check(I::INDEX, Self::LANES) };
        pick(
            self,
            self,
            #[inline(always)]
            |i| I::INDEX[i],
        )
    }

    /// Lane `i` of the result is lane `i + N`, counted round.
    #[inline(always)]
    fn rotate<const N: usize>(self) -> Self {
        pick(
            self,
            self,
            #[inline(always)]
            |i| (i + N) % Self::LANES,
        )
    }

    /// The last lane first.
    #[inline(always)]
    fn reverse(self) -> Self {
        pick(
            self,
            self,
            #[inline(always)]
            |i| Self::LANES - 1 - i,
        )
    }

    /// The lanes of both in turn, `a0 b0 a1 b1 …`: the first half of them and the second.
    #[inline(always)]
    fn zip(self, other: Self) -> (Self, Self) {
        (
            pick(
                self,
                other,
                #[inline(always)]
                |i| i / 2 + i % 2 * Self::LANES,
            ),
            pick(
                self,
                other,
                #[inline(always)]
                |i| (i + Self::LANES) / 2 + i % 2 * Self::LANES,
            ),
        )
    }

    /// The even lanes of `self` and then those of `other`; and the odd ones. The inverse of
    /// [`Lanes::zip`].
    #[inline(always)]
    fn unzip(self, other: Self) -> (Self, Self) {
        (
            pick(
                self,
                other,
                #[inline(always)]
                |i| 2 * i,
            ),
            pick(
                self,
                other,
                #[inline(always)]
                |i| 2 * i + 1,
            ),
        )
    }

    // Reductions, in the tree order of `spec::reduce` on every level

    /// One lane of all. What the reductions below are made of.
    #[doc(hidden)]
    fn reduce<F: reduce::Fold>(self) -> Self::Elem;

    /// One lane of all, in every lane.
    #[doc(hidden)]
    #[inline(always)]
    fn fold_all<F: reduce::Fold>(self) -> Self {
        Self::splat(self.token(), self.reduce::<F>())
    }

    /// The sum of the lanes, added in the order of [`spec::reduce`](crate::spec::reduce).
    #[inline(always)]
    fn reduce_sum(self) -> Self::Elem {
        self.reduce::<reduce::Sum>()
    }

    /// The product of the lanes, in the order of [`spec::reduce`](crate::spec::reduce).
    #[inline(always)]
    fn reduce_product(self) -> Self::Elem {
        self.reduce::<reduce::Product>()
    }

    /// The least of the lanes by [`Lanes::min`], in the order of
    /// [`spec::reduce`](crate::spec::reduce); which matters to NaN and zeros only.
    #[inline(always)]
    fn reduce_min(self) -> Self::Elem {
        self.reduce::<reduce::Min>()
    }

    /// The greatest of the lanes by [`Lanes::max`], in the order of
    /// [`spec::reduce`](crate::spec::reduce); which matters to NaN and zeros only.
    #[inline(always)]
    fn reduce_max(self) -> Self::Elem {
        self.reduce::<reduce::Max>()
    }

    /// [`spec::argmin`](crate::spec::argmin): the lane of the least value among the mask's lanes,
    /// and that value; the lowest lane of several. A NaN is never the least.
    #[inline(always)]
    fn argmin(self, mask: Self::Mask) -> Option<(usize, Self::Elem)> {
        let allowed = mask & self.eq(self);
        let greatest = Self::splat(self.token(), Self::Elem::GREATEST);
        let least = Self::select(allowed, self, greatest).fold_all::<reduce::Min>();
        let lane = (allowed & self.eq(least)).first()?;
        Some((lane, self.lane(lane)))
    }

    /// [`spec::argmax`](crate::spec::argmax): the lane of the greatest value among the mask's
    /// lanes, and that value; the lowest lane of several. A NaN is never the greatest.
    #[inline(always)]
    fn argmax(self, mask: Self::Mask) -> Option<(usize, Self::Elem)> {
        let allowed = mask & self.eq(self);
        let least = Self::splat(self.token(), Self::Elem::LEAST);
        let greatest = Self::select(allowed, self, least).fold_all::<reduce::Max>();
        let lane = (allowed & self.eq(greatest)).first()?;
        Some((lane, self.lane(lane)))
    }
}

/// Copies fewer elements than sixteen to the start of a slice: by fixed lengths, which need no
/// call.
#[inline(always)]
fn copy_prefix<T: Copy>(from: &[T], to: &mut [T]) {
    let mut at = 0;
    for length in [8, 4, 2, 1] {
        if from.len() & length != 0 {
            to[at..at + length].copy_from_slice(&from[at..at + length]);
            at += length;
        }
    }
}

/// Lanes of two vectors in a new order: indices count through `a` and then through `b`.
#[inline(always)]
fn pick<V: Lanes>(a: V, b: V, index: impl Fn(usize) -> usize) -> V {
    let (lanes_a, lanes_b) = (a.to_array(), b.to_array());
    let lanes = LaneArray::from_fn(
        #[inline(always)]
        |i| match index(i) {
            lane if lane < V::LANES => lanes_a.as_ref()[lane],
            lane => lanes_b.as_ref()[lane - V::LANES],
        },
    );
    V::from_array(a.token(), lanes)
}

/// [`Lanes::load_prefix`] by halves: a register that is put together in memory would be read
/// before it is all written.
#[inline(always)]
pub(crate) fn load_prefix<V: Wide>(s: V::Simd, from: &[V::Elem], fill: V::Elem) -> V {
    match from.split_at_checked(V::LANES / 2) {
        Some((low, high)) => V::concat(V::Half::load(s, low), V::Half::load_prefix(s, high, fill)),
        None => V::concat(V::Half::load_prefix(s, from, fill), V::Half::splat(s, fill)),
    }
}

/// A type of twice the lanes of another.
pub trait Wide: Lanes {
    /// The type of half the lanes.
    type Half: Lanes<Simd = Self::Simd, Elem = Self::Elem>;

    /// One of two, the lower lanes first.
    fn concat(low: Self::Half, high: Self::Half) -> Self;

    /// The lower lanes and the higher.
    fn halves(self) -> (Self::Half, Self::Half);
}
