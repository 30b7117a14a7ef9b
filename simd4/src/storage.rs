//! Lanes at rest: blocks of plain numbers, aligned as a register is, and a buffer of them.
//!
//! Vectors themselves are not for keeping: which registers they live in depends on the level. A
//! block is the same bytes on every machine, of any level, and any bits in it are a value.

use core::ops::{Deref, DerefMut};

use crate::{Element, LaneArray};

/// Numbers that lie in memory as one register's lanes do, aligned to their size.
pub trait Block: Copy + Send + Sync + 'static {
    /// The numbers.
    type Array: LaneArray<Self::Elem>;
    /// One of them.
    type Elem: Element;

    /// The numbers, lane 0 first.
    fn array(&self) -> &Self::Array;
    /// The numbers, lane 0 first.
    fn array_mut(&mut self) -> &mut Self::Array;
}

macro_rules! block {
    ($(#[$doc:meta])* $Block:ident, $lanes:literal, $align:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        #[repr(C, align($align))]
        pub struct $Block<T>(pub [T; $lanes]);

        impl<T: Element> Block for $Block<T> {
            type Array = [T; $lanes];
            type Elem = T;

            #[inline(always)]
            fn array(&self) -> &[T; $lanes] {
                &self.0
            }
            #[inline(always)]
            fn array_mut(&mut self) -> &mut [T; $lanes] {
                &mut self.0
            }
        }

        impl<T> From<[T; $lanes]> for $Block<T> {
            #[inline(always)]
            fn from(lanes: [T; $lanes]) -> Self {
                $Block(lanes)
            }
        }

        impl<T> From<$Block<T>> for [T; $lanes] {
            #[inline(always)]
            fn from(block: $Block<T>) -> Self {
                block.0
            }
        }

        impl<T> Deref for $Block<T> {
            type Target = [T; $lanes];
            #[inline(always)]
            fn deref(&self) -> &[T; $lanes] {
                &self.0
            }
        }

        impl<T> DerefMut for $Block<T> {
            #[inline(always)]
            fn deref_mut(&mut self) -> &mut [T; $lanes] {
                &mut self.0
            }
        }
    };
}

block! {
    /// Four numbers, aligned to 16 bytes.
    Block4, 4, 16
}
block! {
    /// Eight numbers, aligned to 32 bytes.
    Block8, 8, 32
}
block! {
    /// Sixteen numbers, aligned to 64 bytes: a cache line.
    Block16, 16, 64
}

#[cfg(feature = "std")]
pub use buffer::AlignedBuf;

#[cfg(feature = "std")]
mod buffer {
    use core::fmt;
    use core::ops::{Deref, DerefMut};

    use super::Block16;
    use crate::Element;

    /// A slice of numbers on the heap that starts at a multiple of 64 bytes, and is filled up
    /// with zeros to one: the blocks can be read whole.
    ///
    /// ```
    /// use simd4::{AlignedBuf, f32x8, prelude::*};
    ///
    /// let mut buf = AlignedBuf::from([1.0, 2.0, 3.0].as_slice());
    /// buf[0] = 5.0;
    /// assert_eq!(buf.as_ptr() as usize % 64, 0);
    /// assert_eq!(buf.blocks()[0][..5], [5.0, 2.0, 3.0, 0.0, 0.0]);
    /// ```
    #[derive(Clone, Default)]
    pub struct AlignedBuf<T> {
        blocks: Vec<Block16<T>>,
        len: usize,
    }

    impl<T: Element> AlignedBuf<T> {
        /// So many zeros.
        pub fn zeroed(len: usize) -> Self {
            AlignedBuf { blocks: vec![Block16::default(); len.div_ceil(16)], len }
        }

        /// Grows with zeros or cuts.
        pub fn resize(&mut self, len: usize) {
            if len < self.len {
                self[len..].fill(T::default());
            }
            self.blocks.resize(len.div_ceil(16), Block16::default());
            self.len = len;
        }

        /// The numbers by sixteen; those beyond the length are zeros, unless
        /// [`AlignedBuf::blocks_mut`] was used to change them.
        pub fn blocks(&self) -> &[Block16<T>] {
            &self.blocks
        }

        /// The numbers by sixteen.
        pub fn blocks_mut(&mut self) -> &mut [Block16<T>] {
            &mut self.blocks
        }
    }

    impl<T: Element> Deref for AlignedBuf<T> {
        type Target = [T];
        #[inline]
        fn deref(&self) -> &[T] {
            // SAFETY: a block is sixteen `T` without padding (16 × 4 bytes, aligned to 64), so
            // the vector's memory is `16 * blocks.len()` of them, and `len` is never more.
            unsafe { core::slice::from_raw_parts(self.blocks.as_ptr().cast(), self.len) }
        }
    }

    impl<T: Element> DerefMut for AlignedBuf<T> {
        #[inline]
        fn deref_mut(&mut self) -> &mut [T] {
            // SAFETY: as in `deref`; the borrow is exclusive, and any `T` may be written.
            unsafe { core::slice::from_raw_parts_mut(self.blocks.as_mut_ptr().cast(), self.len) }
        }
    }

    impl<T: Element> From<&[T]> for AlignedBuf<T> {
        fn from(from: &[T]) -> Self {
            let mut buf = AlignedBuf::zeroed(from.len());
            buf.copy_from_slice(from);
            buf
        }
    }

    impl<T: Element> FromIterator<T> for AlignedBuf<T> {
        fn from_iter<I: IntoIterator<Item = T>>(iter: I) -> Self {
            let mut buf = AlignedBuf { blocks: Vec::new(), len: 0 };
            for x in iter {
                if buf.len == 16 * buf.blocks.len() {
                    buf.blocks.push(Block16::default());
                }
                buf.blocks[buf.len / 16].0[buf.len % 16] = x;
                buf.len += 1;
            }
            buf
        }
    }

    impl<T: Element> PartialEq for AlignedBuf<T> {
        fn eq(&self, other: &Self) -> bool {
            **self == **other
        }
    }

    impl<T: Element> fmt::Debug for AlignedBuf<T> {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            (**self).fmt(f)
        }
    }

    #[cfg(test)]
    mod tests {
        use super::AlignedBuf;

        #[test]
        fn what_goes_in_comes_out_aligned_and_filled_up() {
            for n in [0, 1, 15, 16, 17, 100] {
                let source: Vec<u32> = (1..=n).collect();
                let buf: AlignedBuf<u32> = source.iter().copied().collect();
                assert_eq!(*buf, *source);
                assert_eq!(buf, AlignedBuf::from(source.as_slice()));
                assert_eq!(buf.as_ptr() as usize % 64, 0);
                let all = buf.blocks().iter().flat_map(|block| block.0);
                assert!(all.skip(n as usize).all(|x| x == 0));
            }
        }

        #[test]
        fn cutting_leaves_zeros_behind() {
            let mut buf: AlignedBuf<f32> = (0..40).map(|i| i as f32 + 1.0).collect();
            buf.resize(3);
            assert_eq!(*buf, [1.0, 2.0, 3.0]);
            buf.resize(20);
            assert_eq!(buf[..4], [1.0, 2.0, 3.0, 0.0]);
            assert!(buf[3..].iter().all(|&x| x == 0.0));
            assert_eq!((buf.len(), buf.blocks().len()), (20, 2));
        }
    }
}
