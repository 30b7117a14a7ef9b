//! What kernels keep of triangles, one by one and in lanes.

use simd4::math::Vec3;
use simd4::{Lanes, Simd, SimdF32, SimdInt, spec};

use crate::geom::{Aabb, PADDING, Triangle};
use crate::packet::{Axes, Boxes, OwnAxes, OwnBoxes, SameAxis};

/// What a kernel keeps of a triangle: 48 bytes, three blocks of 16 (Geimer and Müller 2003,
/// Section 3.2). What the three rows of numbers are is the kernel's choice.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub struct Record {
    rows: [Row; 3],
}

/// Three numbers, and a word in the padding: the triangle's number in the first row, an axis in the
/// second.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct Row {
    numbers: [f32; 3],
    word: u32,
}

const _: () = assert!(size_of::<Record>() == 48);

impl Record {
    /// Three rows and an axis, 0 to 2.
    pub fn new(rows: [[f32; 3]; 3], prim: u32, axis: u32) -> Record {
        let [a, b, c] = rows;
        let row = |numbers, word| Row { numbers, word };
        Record { rows: [row(a, prim), row(b, axis), row(c, 0)] }
    }

    /// The corners.
    pub fn corners(triangle: &Triangle, prim: u32) -> Record {
        Record::new(triangle.corners.map(|corner| corner.to_array()), prim, 0)
    }

    /// The triangle's number.
    pub fn number(&self) -> u32 {
        self.rows[0].word
    }

    /// The same with rows for columns.
    pub(super) fn transposed(&self) -> Record {
        let [a, b, c] = self.rows.map(|row| row.numbers);
        let column = |k: usize| [a[k], b[k], c[k]];
        Record::new([column(0), column(1), column(2)], self.number(), self.rows[1].word)
    }

    /// The axis.
    #[inline(always)]
    pub(super) fn axis(&self) -> usize {
        self.rows[1].word as usize
    }

    /// A row in one register; the fourth lane is of no account.
    #[inline(always)]
    pub(super) fn row<S: Simd>(&self, s: S, k: usize) -> S::f32x4 {
        block(s, self.rows[k].numbers)
    }

    /// What no ray meets, with any kernel.
    pub fn nothing() -> Record {
        Record::new([[f32::NAN; 3]; 3], 0, 0)
    }
}

/// Records as a kernel sees them: one in all lanes (`&Record`) or each lane its own ([`BlockLanes`]).
pub trait Records<V: SimdF32> {
    /// Whether a kernel is to be done early where no lane can hit. If not, it goes on: where the branch
    /// would be a guess, that takes less time.
    const EARLY_OUT: bool = true;

    /// Where the records' axes differ, their choice does.
    type Axes: Axes<V>;
    /// As many boxes.
    type Boxes: Boxes<V>;

    /// Number `k` of a row.
    fn get(&self, s: V::Simd, row: usize, k: usize) -> V;

    /// The triangles' numbers.
    fn prim(&self, s: V::Simd) -> V::U32;

    /// The records' axes.
    fn axes(&self, s: V::Simd) -> Self::Axes;

    /// The own boxes of triangles of which the rows are the corners, the same bits as
    /// [`Triangle::own_box`].
    fn own_boxes(&self, s: V::Simd) -> Self::Boxes;

    /// A row.
    #[inline(always)]
    fn vec3(&self, s: V::Simd, row: usize) -> Vec3<V> {
        Vec3::new(self.get(s, row, 0), self.get(s, row, 1), self.get(s, row, 2))
    }
}

impl<V: SimdF32> Records<V> for Record {
    type Axes = SameAxis;
    type Boxes = Aabb;

    #[inline(always)]
    fn get(&self, s: V::Simd, row: usize, k: usize) -> V {
        V::splat(s, self.rows[row].numbers[k.min(2)])
    }

    #[inline(always)]
    fn prim(&self, s: V::Simd) -> V::U32 {
        V::U32::splat(s, self.rows[0].word)
    }

    #[inline(always)]
    fn axes(&self, _: V::Simd) -> SameAxis {
        SameAxis::new(self.rows[1].word as usize)
    }

    /// All axes at once.
    #[inline(always)]
    fn own_boxes(&self, s: V::Simd) -> Aabb {
        own_box(s, self)
    }
}

#[inline(always)]
fn own_box<S: Simd>(s: S, Record { rows: [a, b, c] }: &Record) -> Aabb {
    let (a, b, c) = (block(s, a.numbers), block(s, b.numbers), block(s, c.numbers));
    let min = a.min(b).min(c);
    let max = a.max(b).max(c);
    let [x, y, z, _] = (max - min).to_array();
    let extent = spec::max(spec::max(x, y), z);
    let magnitude = min.abs().max(max.abs());
    let pad = S::f32x4::splat(s, extent * PADDING) + magnitude * S::f32x4::splat(s, f32::EPSILON);
    let [x0, y0, z0, _] = (min - pad).to_array();
    let [x1, y1, z1, _] = (max + pad).to_array();
    Aabb { axes: [[x0, x1], [y0, y1], [z0, z1]] }
}

/// A corner in one register; the fourth lane is of no account.
#[inline(always)]
fn block<S: Simd>(s: S, [x, y, z]: [f32; 3]) -> S::f32x4 {
    S::f32x4::from_array(s, [x, y, z, 0.0])
}

/// Records by component (SoA), sixteen of them unless stated: as many steps of lanes as a level needs
/// for them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct RecordBlock<const N: usize = 16> {
    numbers: [[[f32; N]; 3]; 3],
    /// The triangles' numbers, and in the upper two bits the axes.
    words: [u32; N],
}

impl<const N: usize> RecordBlock<N> {
    /// The number of records in a block.
    pub const LANES: usize = N;

    /// The bits of a word below the axis.
    const NUMBER: u32 = u32::MAX >> 2;

    /// As the number of a record that is nothing.
    const NO_PRIM: u32 = Self::NUMBER;

    /// At most so many records; the rest of the block is [nothing](Record::nothing).
    ///
    /// # Panics
    /// If there are more.
    #[inline(always)]
    pub fn new(records: impl IntoIterator<Item = Record>) -> Self {
        let (numbers, words) = ([[[f32::NAN; N]; 3]; 3], [Self::NO_PRIM; N]);
        let mut block = RecordBlock { numbers, words };
        for (lane, record) in records.into_iter().enumerate() {
            for (rows, row) in block.numbers.iter_mut().zip(record.rows) {
                for (numbers, number) in rows.iter_mut().zip(row.numbers) {
                    numbers[lane] = number;
                }
            }
            block.words[lane] = record.rows[0].word & Self::NUMBER | record.rows[1].word << 30;
        }
        block
    }

    /// The numbers of the triangles that it was made of.
    pub(crate) fn prims(&self) -> impl Iterator<Item = u32> {
        let numbers = self.words.iter().map(|word| word & Self::NUMBER);
        numbers.filter(|&number| number != Self::NO_PRIM)
    }
}

/// The own boxes of all triangles of a block, to be had one by one.
pub(crate) struct OwnBoxLanes<B: SimdF32>([[B::Array; 2]; 3]);

impl<B: SimdF32> OwnBoxLanes<B> {
    /// Of triangles whose records are their corners.
    #[inline(always)]
    pub(crate) fn new<R: Records<B, Boxes = OwnBoxes<B>>>(s: B::Simd, records: &R) -> Self {
        let OwnBoxes([[x0, x1], [y0, y1], [z0, z1]]) = records.own_boxes(s);
        OwnBoxLanes([
            [x0.to_array(), x1.to_array()],
            [y0.to_array(), y1.to_array()],
            [z0.to_array(), z1.to_array()],
        ])
    }

    /// One record of the block, in all lanes.
    #[inline(always)]
    pub(crate) fn one<'a, const N: usize>(
        &'a self,
        block: &'a RecordBlock<N>,
        lane: usize,
    ) -> OneOf<'a, B, N> {
        OneOf { block, own_boxes: self, lane: lane & (N - 1) & (B::LANES - 1) }
    }
}

/// One record of a block in all lanes.
pub(crate) struct OneOf<'a, B: SimdF32, const N: usize> {
    block: &'a RecordBlock<N>,
    own_boxes: &'a OwnBoxLanes<B>,
    lane: usize,
}

impl<V: SimdF32, B: SimdF32, const N: usize> Records<V> for OneOf<'_, B, N> {
    type Axes = SameAxis;
    type Boxes = Aabb;

    #[inline(always)]
    fn get(&self, s: V::Simd, row: usize, k: usize) -> V {
        V::splat(s, self.block.numbers[row][k.min(2)][self.lane])
    }

    #[inline(always)]
    fn prim(&self, s: V::Simd) -> V::U32 {
        V::U32::splat(s, self.block.words[self.lane] & RecordBlock::<N>::NUMBER)
    }

    #[inline(always)]
    fn axes(&self, _: V::Simd) -> SameAxis {
        SameAxis::new((self.block.words[self.lane] >> 30) as usize)
    }

    #[inline(always)]
    fn own_boxes(&self, _: V::Simd) -> Aabb {
        let [[x0, x1], [y0, y1], [z0, z1]] = &self.own_boxes.0;
        let lane = self.lane;
        Aabb {
            axes: [
                [x0.as_ref()[lane], x1.as_ref()[lane]],
                [y0.as_ref()[lane], y1.as_ref()[lane]],
                [z0.as_ref()[lane], z1.as_ref()[lane]],
            ],
        }
    }
}

/// Some neighbours in a block, as many as a vector has lanes; with or without an early
/// [way out](Records::EARLY_OUT).
#[derive(Clone, Copy, Debug)]
pub struct BlockLanes<'a, const N: usize = 16, const EARLY_OUT: bool = true> {
    block: &'a RecordBlock<N>,
    first: usize,
}

impl<'a, const N: usize> BlockLanes<'a, N> {
    /// Those from `first` on, which is a multiple of the number of lanes.
    #[inline(always)]
    pub fn new(block: &'a RecordBlock<N>, first: usize) -> Self {
        BlockLanes { block, first }
    }

    /// The same, to be tested to the end.
    #[inline(always)]
    pub(crate) fn without_early_out(self) -> BlockLanes<'a, N, false> {
        let BlockLanes { block, first } = self;
        BlockLanes { block, first }
    }
}

impl<const N: usize, const EARLY_OUT: bool> BlockLanes<'_, N, EARLY_OUT> {
    /// The lanes of some numbers of the block.
    #[inline(always)]
    fn load<V: Lanes>(&self, s: V::Simd, from: &[V::Elem; N]) -> V {
        // The mask tells the compiler that the lanes are within the block.
        V::load(s, &from[self.first & (N - V::LANES)..])
    }
}

impl<V: SimdF32, const N: usize, const EARLY_OUT: bool> Records<V>
    for BlockLanes<'_, N, EARLY_OUT>
{
    const EARLY_OUT: bool = EARLY_OUT;

    type Axes = OwnAxes<V::Mask>;
    type Boxes = OwnBoxes<V>;

    #[inline(always)]
    fn get(&self, s: V::Simd, row: usize, k: usize) -> V {
        self.load(s, &self.block.numbers[row][k.min(2)])
    }

    #[inline(always)]
    fn prim(&self, s: V::Simd) -> V::U32 {
        let words: V::U32 = self.load(s, &self.block.words);
        words & V::U32::splat(s, RecordBlock::<N>::NUMBER)
    }

    #[inline(always)]
    fn axes(&self, s: V::Simd) -> OwnAxes<V::Mask> {
        let words: V::U32 = self.load(s, &self.block.words);
        let axis = words.shr(30);
        OwnAxes([axis.eq(V::U32::splat(s, 0)), axis.eq(V::U32::splat(s, 1))])
    }

    #[inline(always)]
    fn own_boxes(&self, s: V::Simd) -> OwnBoxes<V> {
        let [a, b, c]: [Vec3<V>; 3] = [self.vec3(s, 0), self.vec3(s, 1), self.vec3(s, 2)];
        let (x, y, z) = (range(a.x, b.x, c.x), range(a.y, b.y, c.y), range(a.z, b.z, c.z));
        OwnBoxes::padded(s, [x, y, z])
    }
}

/// The least and the greatest of three.
#[inline(always)]
fn range<V: SimdF32>(a: V, b: V, c: V) -> [V; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}
