//! How long something took; where the machine has no clock (WebAssembly without a host), nothing takes time.

/// A moment from which time is counted.
#[derive(Clone, Copy, Debug)]
pub struct Since(#[cfg(not(target_family = "wasm"))] std::time::Instant);

impl Since {
    /// From now on.
    pub fn now() -> Self {
        Self(
            #[cfg(not(target_family = "wasm"))]
            std::time::Instant::now(),
        )
    }

    /// Seconds since then; 0 without a clock.
    pub fn seconds(&self) -> f64 {
        #[cfg(not(target_family = "wasm"))]
        return self.0.elapsed().as_secs_f64();
        #[cfg(target_family = "wasm")]
        0.0
    }
}
