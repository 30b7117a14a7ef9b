//! What kernels keep of curved surfaces, one by one and in lanes.

use simd4::math::Vec3;
use simd4::{Block16, Lanes, SimdF32};

use super::cone::ConeRecord;
use crate::geom::{Aabb, Quadric, Sphere};
use crate::packet::{Boxes, OwnBoxes};

/// A record's numbers: the centre, a size, M, the axis, the range and the linear coefficients.
const NUMBERS: usize = 18;
const CENTER: usize = 0;
const SIZE: usize = 3;
const MATRIX: usize = 4;
const AXIS: usize = 10;
const RANGE: usize = 13;
const LINEAR: usize = 15;

/// Of a cone: where others have M, the own box; where they have the range, the cosine and the sine of
/// half the angle, and the radius.
const OWN_BOX: usize = MATRIX;
const OPENING: usize = RANGE;

/// What a kernel keeps of a surface. A form reads those numbers that it needs.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    numbers: [f32; NUMBERS],
    prim: u32,
}

impl Record {
    /// The size is the radius.
    pub fn sphere(Sphere { center, radius }: &Sphere, prim: u32) -> Record {
        let mut numbers = [0.0; NUMBERS];
        numbers[CENTER..][..3].copy_from_slice(&center.to_array());
        numbers[SIZE] = *radius;
        Record { numbers, prim }
    }

    /// The size is the level.
    pub fn central(quadric: &Quadric, prim: u32) -> Record {
        let mut numbers = [0.0; NUMBERS];
        numbers[CENTER..][..3].copy_from_slice(&quadric.center.to_array());
        numbers[SIZE] = quadric.level;
        numbers[MATRIX..][..6].copy_from_slice(&quadric.matrix);
        numbers[AXIS..][..3].copy_from_slice(&quadric.axis.to_array());
        numbers[RANGE..][..2].copy_from_slice(&quadric.range);
        Record { numbers, prim }
    }

    /// The same, multiplied out about the world's origin: the size is the level there.
    pub fn world(quadric: &Quadric, prim: u32) -> Record {
        let mut record = Record::central(quadric, prim);
        let center = quadric.center.as_dvec3();
        let turned = quadric.matrix().as_dmat3() * center;
        record.numbers[CENTER..][..3].fill(0.0);
        record.numbers[LINEAR..][..3].copy_from_slice(&(-turned).as_vec3().to_array());
        record.numbers[SIZE] = (f64::from(quadric.level) - center.dot(turned)) as f32;
        let along = quadric.axis.as_dvec3().dot(center);
        let range = quadric.range.map(|end| (f64::from(end) + along) as f32);
        record.numbers[RANGE..][..2].copy_from_slice(&range);
        record
    }

    /// The centre is that of the base, the size the height.
    pub(super) fn cone(cone: &ConeRecord) -> Record {
        let mut numbers = [0.0; NUMBERS];
        numbers[CENTER..][..3].copy_from_slice(&cone.base);
        numbers[SIZE] = cone.height;
        numbers[OWN_BOX..][..6].copy_from_slice(cone.own_box.axes.as_flattened());
        numbers[AXIS..][..3].copy_from_slice(&cone.axis);
        numbers[OPENING..][..3].copy_from_slice(&[cone.cos, cone.sin, cone.radius]);
        Record { numbers, prim: cone.prim }
    }

    /// What no ray meets, with any kernel.
    fn nothing() -> Record {
        Record { numbers: [f32::NAN; NUMBERS], prim: 0 }
    }
}

/// Records as a kernel sees them: one in all lanes (`&Record`) or each lane its own
/// (`BlockLanes`).
pub trait Records<V: SimdF32> {
    /// As many boxes.
    type Boxes: Boxes<V>;

    /// One of the numbers.
    fn get(&self, s: V::Simd, k: usize) -> V;

    /// The surfaces' numbers.
    fn prim(&self, s: V::Simd) -> V::U32;

    /// The own boxes of spheres, the same bits as [`Sphere::own_box`].
    fn own_boxes(&self, s: V::Simd) -> Self::Boxes;

    /// The own boxes of cones.
    fn cone_boxes(&self, s: V::Simd) -> Self::Boxes;

    /// Three of the numbers.
    #[inline(always)]
    fn vec3(&self, s: V::Simd, k: usize) -> Vec3<V> {
        Vec3::new(self.get(s, k), self.get(s, k + 1), self.get(s, k + 2))
    }

    /// The centre.
    #[inline(always)]
    fn center(&self, s: V::Simd) -> Vec3<V> {
        self.vec3(s, CENTER)
    }

    /// The radius of a sphere, the level of a quadric.
    #[inline(always)]
    fn size(&self, s: V::Simd) -> V {
        self.get(s, SIZE)
    }

    /// The rows of M.
    #[inline(always)]
    fn matrix(&self, s: V::Simd) -> [Vec3<V>; 3] {
        let (diagonal, others) = (self.vec3(s, MATRIX), self.vec3(s, MATRIX + 3));
        let Vec3 { x: yz, y: zx, z: xy } = others;
        [
            Vec3::new(diagonal.x, xy, zx),
            Vec3::new(xy, diagonal.y, yz),
            Vec3::new(zx, yz, diagonal.z),
        ]
    }

    /// The cosine and the sine of half a cone's angle, and its radius at the base times the cosine.
    #[inline(always)]
    fn opening(&self, s: V::Simd) -> [V; 3] {
        [self.get(s, OPENING), self.get(s, OPENING + 1), self.get(s, OPENING + 2)]
    }

    /// What points are measured along.
    #[inline(always)]
    fn axis(&self, s: V::Simd) -> Vec3<V> {
        self.vec3(s, AXIS)
    }

    /// From where to where the surface goes along the axis.
    #[inline(always)]
    fn range(&self, s: V::Simd) -> [V; 2] {
        [self.get(s, RANGE), self.get(s, RANGE + 1)]
    }

    /// The linear coefficients, halved.
    #[inline(always)]
    fn linear(&self, s: V::Simd) -> Vec3<V> {
        self.vec3(s, LINEAR)
    }
}

impl<V: SimdF32> Records<V> for Record {
    type Boxes = Aabb;

    #[inline(always)]
    fn get(&self, s: V::Simd, k: usize) -> V {
        V::splat(s, self.numbers[k])
    }

    #[inline(always)]
    fn prim(&self, s: V::Simd) -> V::U32 {
        V::U32::splat(s, self.prim)
    }

    #[inline(always)]
    fn own_boxes(&self, _: V::Simd) -> Aabb {
        let [x, y, z, radius, ..] = self.numbers;
        Sphere { center: glam::Vec3::new(x, y, z), radius }.own_box()
    }

    #[inline(always)]
    fn cone_boxes(&self, _: V::Simd) -> Aabb {
        let [x0, x1, y0, y1, z0, z1] = *self.numbers[OWN_BOX..].first_chunk().expect("six of them");
        Aabb { axes: [[x0, x1], [y0, y1], [z0, z1]] }
    }
}

/// Sixteen records by component (SoA): as many steps of lanes as a level needs for them.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct RecordBlock {
    numbers: [Block16<f32>; NUMBERS],
    prim: Block16<u32>,
}

impl RecordBlock {
    /// The number of records in a block.
    pub const LANES: usize = 16;

    /// At most sixteen records; the rest of the block is nothing that a ray could meet.
    ///
    /// # Panics
    /// If there are more.
    pub fn new(records: &[Record]) -> RecordBlock {
        let nothing = Record::nothing();
        let mut block = RecordBlock {
            numbers: nothing.numbers.map(|number| Block16([number; 16])),
            prim: Block16([nothing.prim; 16]),
        };
        for (lane, record) in records.iter().enumerate() {
            for (numbers, number) in block.numbers.iter_mut().zip(record.numbers) {
                numbers[lane] = number;
            }
            block.prim[lane] = record.prim;
        }
        block
    }
}

/// Some neighbours in a block, as many as a vector has lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockLanes<'a> {
    block: &'a RecordBlock,
    first: usize,
}

impl<'a> BlockLanes<'a> {
    /// Those from `first` on, which is a multiple of the number of lanes.
    #[inline(always)]
    pub(super) fn new(block: &'a RecordBlock, first: usize) -> Self {
        BlockLanes { block, first }
    }

    /// The lanes of some numbers of the block.
    #[inline(always)]
    fn load<V: Lanes>(&self, s: V::Simd, from: &Block16<V::Elem>) -> V {
        // The mask tells the compiler that the lanes are within the block.
        V::load(s, &from.0[self.first & (RecordBlock::LANES - V::LANES)..])
    }
}

impl<V: SimdF32> Records<V> for BlockLanes<'_> {
    type Boxes = OwnBoxes<V>;

    #[inline(always)]
    fn get(&self, s: V::Simd, k: usize) -> V {
        self.load(s, &self.block.numbers[k])
    }

    #[inline(always)]
    fn prim(&self, s: V::Simd) -> V::U32 {
        self.load(s, &self.block.prim)
    }

    #[inline(always)]
    fn own_boxes(&self, s: V::Simd) -> OwnBoxes<V> {
        let (Vec3 { x, y, z }, radius): (Vec3<V>, V) = (self.center(s), self.size(s));
        let (x, y, z) = (about(x, radius), about(y, radius), about(z, radius));
        OwnBoxes::padded(s, [x, y, z])
    }

    #[inline(always)]
    fn cone_boxes(&self, s: V::Simd) -> OwnBoxes<V> {
        let (low, high): (Vec3<V>, Vec3<V>) = (self.vec3(s, OWN_BOX), self.vec3(s, OWN_BOX + 3));
        OwnBoxes([[low.x, low.y], [low.z, high.x], [high.y, high.z]])
    }
}

#[inline(always)]
fn about<V: SimdF32>(center: V, radius: V) -> [V; 2] {
    [center - radius, center + radius]
}
