//! Mailboxes: what keeps a ray, or a packet, from being tested twice against a primitive that several
//! cells have.
//!
//! A test that is repeated finds what it found before, so hits do not depend on mailboxes; to forget
//! a test costs time only. Source: Wald et al. 2001, Section 2.3.

use std::sync::atomic::{AtomicU64, Ordering};

/// The kind of mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mailbox {
    /// None: whatever is met again is tested again.
    None,
    /// A stamp for each primitive: the last packet that was tested. All threads write to the same
    /// stamps, and take their cache lines from each other.
    Stamps,
    /// A table of 2^N entries for each thread, in which the number of a primitive is its place: what
    /// comes to the same place is forgotten.
    Hashed(u8),
    /// The last primitives that a packet was tested against: inverse mailboxing (Shevtsov, Soupikov,
    /// Kapustin 2007).
    Inverse,
}

impl Default for Mailbox {
    fn default() -> Self {
        Mailbox::Hashed(6)
    }
}

/// How many primitives inverse mailboxing remembers.
const REMEMBERED: usize = 8;

/// The stamps that all threads share.
#[derive(Debug, Default)]
pub(crate) struct Stamps {
    stamps: Vec<AtomicU64>,
    /// How many packets there were.
    packets: AtomicU64,
}

impl Stamps {
    /// For so many primitives, if there is need for them.
    pub(crate) fn new(mailbox: Mailbox, slots: usize) -> Stamps {
        let slots = if mailbox == Mailbox::Stamps { slots } else { 0 };
        Stamps { stamps: (0..slots).map(|_| AtomicU64::new(0)).collect(), ..Stamps::default() }
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.stamps)
    }
}

impl Clone for Stamps {
    fn clone(&self) -> Stamps {
        Stamps {
            stamps: self.stamps.iter().map(|_| AtomicU64::new(0)).collect(),
            ..Stamps::default()
        }
    }
}

/// The mailbox of one thread, for a batch.
pub(crate) enum Mail<'a> {
    None,
    Stamps { stamps: &'a Stamps, packet: u64 },
    Hashed { table: Vec<(u32, u32)>, packet: u32 },
    Inverse { last: [u32; REMEMBERED], next: usize },
}

impl<'a> Mail<'a> {
    pub(crate) fn new(mailbox: Mailbox, stamps: &'a Stamps) -> Mail<'a> {
        match mailbox {
            Mailbox::None => Mail::None,
            Mailbox::Stamps => Mail::Stamps { stamps, packet: 0 },
            Mailbox::Hashed(bits) => {
                Mail::Hashed { table: vec![(0, 0); 1 << bits.min(24)], packet: 0 }
            }
            Mailbox::Inverse => Mail::Inverse { last: [u32::MAX; REMEMBERED], next: 0 },
        }
    }

    /// Begins with the next packet.
    #[inline(always)]
    pub(crate) fn next_packet(&mut self) {
        match self {
            Mail::None => {}
            // No packet is 0, and none comes twice.
            Mail::Stamps { stamps, packet } => {
                *packet = stamps.packets.fetch_add(1, Ordering::Relaxed) + 1;
            }
            Mail::Hashed { table, packet } => {
                *packet = packet.wrapping_add(1);
                if *packet == 0 {
                    table.fill((0, 0));
                    *packet = 1;
                }
            }
            Mail::Inverse { last, .. } => *last = [u32::MAX; REMEMBERED],
        }
    }

    /// Whether the packet was tested against the primitive in that slot; from now on it was.
    #[inline(always)]
    pub(crate) fn was_tested(&mut self, slot: u32) -> bool {
        match self {
            Mail::None => false,
            Mail::Stamps { stamps, packet } => {
                let Some(stamp) = stamps.stamps.get(slot as usize) else { return false };
                let seen = stamp.load(Ordering::Relaxed) == *packet;
                if !seen {
                    stamp.store(*packet, Ordering::Relaxed);
                }
                seen
            }
            Mail::Hashed { table, packet } => {
                let at = slot as usize & (table.len() - 1);
                let entry = &mut table[at];
                let seen = *entry == (slot, *packet);
                *entry = (slot, *packet);
                seen
            }
            Mail::Inverse { last, next } => {
                let seen = last.contains(&slot);
                if !seen {
                    last[*next % REMEMBERED] = slot;
                    *next += 1;
                }
                seen
            }
        }
    }
}
