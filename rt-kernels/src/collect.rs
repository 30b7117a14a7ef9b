//! Many values at once, by all threads that there are.

use std::mem::MaybeUninit;

use crate::Join;

/// The least number of values of which the halves may be made at once.
const PARALLEL: usize = 1 << 12;

/// So many values, each made by its number.
///
/// Nothing is written before what is to be there: to touch memory for the first time takes as long as to
/// fill it, and here it is not the work of one thread.
pub(crate) fn collect<T: Copy + Send>(
    count: usize,
    join: &impl Join,
    make: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let mut values = Vec::with_capacity(count);
    write(&mut values.spare_capacity_mut()[..count], 0, join, &make);
    // SAFETY: the capacity is `count` or more, and so many places are written to: both halves of every
    // slice, since `join` does not know the types that it returns, and has none but by calling both. (`T`
    // is `Copy`, so that nothing is lost should one panic.)
    unsafe { values.set_len(count) };
    values
}

fn write<T: Send>(
    places: &mut [MaybeUninit<T>],
    first: usize,
    join: &impl Join,
    make: &(impl Fn(usize) -> T + Sync),
) {
    if places.len() >= PARALLEL {
        let middle = places.len() / 2;
        let (places, more) = places.split_at_mut(middle);
        join.join(|| write(places, first, join, make), || write(more, first + middle, join, make));
        return;
    }
    for (i, place) in (first..).zip(places) {
        place.write(make(i));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sequential;

    /// The second before the first.
    struct Backwards;

    impl Join for Backwards {
        fn join<A: Send, B: Send>(
            &self,
            a: impl FnOnce() -> A + Send,
            b: impl FnOnce() -> B + Send,
        ) -> (A, B) {
            let b = b();
            (a(), b)
        }
    }

    #[test]
    fn values_are_in_the_order_of_their_numbers() {
        for count in [0, 1, PARALLEL - 1, PARALLEL, 3 * PARALLEL + 1] {
            let numbers: Vec<_> = (0..count).map(|i| i ^ 5).collect();
            assert_eq!(collect(count, &Sequential, |i| i ^ 5), numbers);
            assert_eq!(collect(count, &Backwards, |i| i ^ 5), numbers);
        }
    }
}
