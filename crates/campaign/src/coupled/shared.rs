//! Tracks and bridges that runs share, also in several threads.

use std::sync::{Arc, Mutex, PoisonError};

use ttb_contract::ModelError;
use ttb_scenario::Checked;

/// A track and a bridge of the coupled way.
pub type Prepared = ttb_session::Prepared<ttb_train_track::Prepared, ttb_bridge::Prepared>;

/// So many are kept; the one not used for longest goes.
const KEPT: usize = 4;

/// Prepared tracks and bridges, the last used first.
#[derive(Default)]
pub struct Shared(Mutex<Vec<Prepared>>);

impl Shared {
    /// One whose bridge serves a scenario, made if there is none. Who comes while one is made waits for it: a large bridge
    /// is prepared once.
    ///
    /// # Errors
    /// Something in the scenario cannot be built.
    pub fn take(&self, checked: &Checked) -> Result<Prepared, ModelError> {
        // Nothing that happens while the lock is held leaves the list half-done.
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let served = |prepared: &Prepared| prepared.serves(checked);
        let best = kept.iter().position(|one| served(one) == [true; 2]);
        let at = match best.or_else(|| kept.iter().position(|one| served(one)[0])) {
            Some(at) => at,
            None => {
                kept.truncate(KEPT - 1);
                kept.push(Prepared::new(checked)?);
                kept.len() - 1
            }
        };
        kept[..=at].rotate_right(1);
        Ok(kept[0].clone())
    }

    /// Keeps a track that was made for a run beside those that are kept.
    pub fn give(&self, prepared: &Prepared, checked: &Checked) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !kept.iter().any(|one| one.serves(checked) == [true; 2]) {
            kept.truncate(KEPT - 1);
            kept.insert(0, prepared.clone());
        }
    }

    /// A bridge that serves a scenario, if one is kept.
    pub fn bridge(&self, checked: &Checked) -> Option<Arc<ttb_bridge::Prepared>> {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.iter().find(|one| one.serves(checked)[0]).map(|one| Arc::clone(one.bridge()))
    }
}
