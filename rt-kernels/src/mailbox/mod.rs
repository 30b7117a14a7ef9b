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
    /// stamps, and take their cache lines from each other: those of a neighbour's stamps too.
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

/// The mailbox of one thread, for a batch. A large packet is tested register by register, and it is
/// remembered which of them were: a bit for each, at most [`GROUPS`].
pub(crate) enum Mail<'a> {
    None,
    Stamps { stamps: &'a Stamps, packet: u64 },
    Hashed { table: Vec<Entry>, packet: u32 },
    Inverse { last: [(u32, u32); REMEMBERED], next: usize },
}

/// The most registers of a packet.
pub(crate) const GROUPS: u32 = 16;

/// What a place of a hash table remembers: the primitive's slot, the packet, and which of its registers
/// were tested.
#[derive(Clone, Copy, Default)]
pub(crate) struct Entry {
    slot: u32,
    packet: u32,
    groups: u32,
}

impl<'a> Mail<'a> {
    pub(crate) fn new(mailbox: Mailbox, stamps: &'a Stamps) -> Mail<'a> {
        match mailbox {
            Mailbox::None => Mail::None,
            Mailbox::Stamps => Mail::Stamps { stamps, packet: 0 },
            Mailbox::Hashed(bits) => {
                Mail::Hashed { table: vec![Entry::default(); 1 << bits.min(24)], packet: 0 }
            }
            Mailbox::Inverse => Mail::Inverse { last: [(u32::MAX, 0); REMEMBERED], next: 0 },
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
                    table.fill(Entry::default());
                    *packet = 1;
                }
            }
            Mail::Inverse { last, .. } => *last = [(u32::MAX, 0); REMEMBERED],
        }
    }

    /// Which of those registers of the packet were not tested against the primitive in that slot; from
    /// now on they were.
    #[inline(always)]
    pub(crate) fn untested(&mut self, slot: u32, groups: u32) -> u32 {
        match self {
            Mail::None => groups,
            Mail::Stamps { stamps, packet } => {
                let Some(stamp) = stamps.stamps.get(slot as usize) else { return groups };
                let now = stamp.load(Ordering::Relaxed);
                let seen =
                    if now >> GROUPS == *packet { now as u32 & ((1 << GROUPS) - 1) } else { 0 };
                let left = groups & !seen;
                if left != 0 {
                    stamp.store(*packet << GROUPS | u64::from(seen | groups), Ordering::Relaxed);
                }
                left
            }
            Mail::Hashed { table, packet } => {
                let at = slot as usize & (table.len() - 1);
                let entry = &mut table[at];
                let same = (entry.slot, entry.packet) == (slot, *packet);
                let seen = if same { entry.groups } else { 0 };
                *entry = Entry { slot, packet: *packet, groups: seen | groups };
                groups & !seen
            }
            Mail::Inverse { last, next } => {
                if let Some((_, seen)) = last.iter_mut().find(|(other, _)| *other == slot) {
                    let left = groups & !*seen;
                    *seen |= groups;
                    return left;
                }
                last[*next % REMEMBERED] = (slot, groups);
                *next += 1;
                groups
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Registers that were not there when others were tested are not left out.
    #[test]
    fn every_register_is_tested_once() {
        for mailbox in [Mailbox::Stamps, Mailbox::Hashed(3), Mailbox::Inverse] {
            let stamps = Stamps::new(mailbox, 20);
            let mut mail = Mail::new(mailbox, &stamps);
            for _ in 0..2 {
                mail.next_packet();
                assert_eq!(mail.untested(5, 0b0011), 0b0011, "{mailbox:?}");
                assert_eq!(mail.untested(6, 0b0110), 0b0110, "{mailbox:?}");
                assert_eq!(mail.untested(5, 0x8006), 0x8004, "{mailbox:?}");
                assert_eq!(mail.untested(5, 0x8007), 0, "{mailbox:?}");
            }
            // To forget is allowed, to mistake is not: 13 has the place of 5.
            assert_eq!(mail.untested(13, 0b1), 0b1, "{mailbox:?}");
        }
        let mut none = Mail::None;
        assert_eq!([none.untested(5, 3), none.untested(5, 3)], [3, 3]);
    }
}
