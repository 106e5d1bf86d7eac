//! Buffers shared between a running model and its saved states: saving is a pointer, stepping writes into a buffer that
//! nobody else holds, and after the first steps nothing is allocated any more.

use std::sync::Arc;

/// Buffers that may be used again once their other holders have dropped them.
#[derive(Debug)]
pub struct Pool<T> {
    buffers: Vec<Arc<T>>,
}

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self { buffers: Vec::new() }
    }
}

impl<T> Pool<T> {
    /// A buffer that is nobody else's, for [`Arc::get_mut`]; made by `new` when all are held by saved states.
    pub fn take(&mut self, new: impl FnOnce() -> T) -> Arc<T> {
        let free = self.buffers.iter_mut().position(|b| Arc::get_mut(b).is_some());
        free.map_or_else(|| Arc::new(new()), |i| self.buffers.swap_remove(i))
    }

    /// Hands a written buffer back for reuse once every other holder has dropped it.
    pub fn give(&mut self, buffer: &Arc<T>) {
        self.buffers.push(Arc::clone(buffer));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_buffer_is_never_handed_out() {
        let mut pool = Pool::default();
        let saved = pool.take(|| 1);
        pool.give(&saved);
        let mut next = pool.take(|| 2);
        assert_eq!(Arc::get_mut(&mut next), Some(&mut 2));
        pool.give(&next);
        drop(next);
        assert_eq!(*pool.take(|| 3), 2);
        assert_eq!(*saved, 1);
    }
}
