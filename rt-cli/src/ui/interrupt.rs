//! Ctrl-C.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

/// Notes that the user does not want to wait.
#[derive(Clone)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// From now on an interrupt ends the program with exit code 130, at once.
    pub(crate) fn new() -> io::Result<Interrupt> {
        let noted = Arc::new(AtomicBool::new(true));
        // In this order: an interrupt that finds another noted ends the program.
        flag::register_conditional_shutdown(SIGINT, 130, Arc::clone(&noted))?;
        flag::register(SIGINT, Arc::clone(&noted))?;
        Ok(Interrupt(noted))
    }

    /// From now on the first interrupt is only noted.
    pub(crate) fn hold(&self) {
        self.0.store(false, Ordering::SeqCst);
    }

    /// Whether one was noted.
    pub(crate) fn is_noted(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}
