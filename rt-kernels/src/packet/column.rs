//! What is kept of each ray of a large packet, and registers of it.

use simd4::math::Vec3;
use simd4::{LaneArray, Lanes, SimdF32};

/// The number of rays in a large packet: a bit for each in a `u64`.
pub const LARGE: usize = 64;

/// A number of each ray of a large packet.
pub(super) type Column<T> = [T; LARGE];

/// The lanes of those bits.
#[inline(always)]
pub(super) fn lanes<V: SimdF32>(s: V::Simd, bits: u64) -> V::Mask {
    let own = V::U32::from_array(s, LaneArray::from_fn(bit));
    (V::U32::splat(s, bits as u32) & own).ne(V::U32::splat(s, 0))
}

#[inline(always)]
fn bit(i: usize) -> u32 {
    1 << i
}

// The mask tells the compiler that the lanes are within the column.

#[inline(always)]
pub(super) fn get<L: Lanes>(s: L::Simd, column: &Column<L::Elem>, at: usize) -> L {
    L::load(s, &column[at & (LARGE - L::LANES)..])
}

#[inline(always)]
pub(super) fn put<L: Lanes>(column: &mut Column<L::Elem>, at: usize, lanes: L) {
    lanes.store(&mut column[at & (LARGE - L::LANES)..]);
}

#[inline(always)]
pub(super) fn get3<V: SimdF32>(s: V::Simd, [x, y, z]: &[Column<f32>; 3], at: usize) -> Vec3<V> {
    Vec3::new(get(s, x, at), get(s, y, at), get(s, z, at))
}

/// In the order of some axes.
#[inline(always)]
pub(super) fn get_by<V: SimdF32>(
    s: V::Simd,
    columns: &[Column<f32>; 3],
    [x, y, z]: [usize; 3],
    at: usize,
) -> [V; 3] {
    [get(s, &columns[x], at), get(s, &columns[y], at), get(s, &columns[z], at)]
}

#[inline(always)]
pub(super) fn put3<V: SimdF32>([x, y, z]: &mut [Column<f32>; 3], at: usize, v: Vec3<V>) {
    put(x, at, v.x);
    put(y, at, v.y);
    put(z, at, v.z);
}

#[inline(always)]
pub(super) fn one3<B: SimdF32>(s: B::Simd, [x, y, z]: &[Column<f32>; 3], ray: usize) -> Vec3<B> {
    Vec3::splat(s, [x[ray], y[ray], z[ray]])
}
