//! Binary files, piece by piece, with the place for messages.

use crate::Error;

/// What is left of a file.
pub(crate) struct Bytes<'a> {
    format: &'static str,
    all: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(format: &'static str, all: &'a [u8]) -> Bytes<'a> {
        Bytes { format, all, at: 0 }
    }

    /// The offset of the next byte.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// Goes to an offset, which may be anything.
    pub(crate) fn seek(&mut self, at: u64) -> Result<(), Error> {
        match usize::try_from(at) {
            Ok(at) if at <= self.all.len() => self.at = at,
            _ => return Err(self.error(format!("there is no byte {at}"))),
        }
        Ok(())
    }

    /// The next so many bytes.
    pub(crate) fn take(&mut self, len: usize) -> Result<&'a [u8], Error> {
        let rest = &self.all[self.at..];
        let Some(taken) = rest.get(..len) else {
            let left = rest.len();
            return Err(self.error(format!("expected {len} more bytes, found {left}")));
        };
        self.at += len;
        Ok(taken)
    }

    /// The next `N` bytes.
    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        Ok(self.take(N)?.try_into().expect("as many as were asked for"))
    }

    pub(crate) fn i32(&mut self) -> Result<i32, Error> {
        self.array().map(i32::from_le_bytes)
    }

    /// A length: a number that is not negative.
    pub(crate) fn len(&mut self) -> Result<usize, Error> {
        let len = self.i32()?;
        usize::try_from(len).map_err(|_| self.error(format!("expected a length, found {len}")))
    }

    /// The bytes before the next zero, of which there are at most 255.
    pub(crate) fn name(&mut self) -> Result<&'a [u8], Error> {
        let rest = &self.all[self.at..];
        let end = rest.iter().take(256).position(|&byte| byte == 0);
        let end = end.ok_or_else(|| self.error("expected a name of up to 255 bytes".to_owned()))?;
        self.at += end + 1;
        Ok(&rest[..end])
    }

    /// What is wrong here.
    pub(crate) fn error(&self, what: String) -> Error {
        Error::Invalid { format: self.format, at: self.at, what }
    }
}
