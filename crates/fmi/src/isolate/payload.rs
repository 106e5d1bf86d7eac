//! The part of the shared memory that grows with what a call carries: a few lists of value references, then values.

use crate::platform::mapping::Mapping;
use crate::platform::memory::Shared;
use std::io;

/// Bytes of data there is room for at the beginning.
pub const FIRST_DATA: usize = 1 << 16;
/// Number of lists of value references that are kept in the payload.
pub const LISTS: usize = 8;

/// The mapped payload.
pub struct Payload {
    mapping: Mapping,
    list_items: usize,
    data: usize,
}

impl Payload {
    /// Bytes of a payload, a multiple of 64 KiB.
    pub fn length(list_items: usize, data: usize) -> usize {
        (LISTS * 4 * list_items + data).next_multiple_of(1 << 16)
    }

    /// Room for `list_items` references in a list, an even number, and for `data` bytes.
    pub fn new(file: &Shared, offset: usize, list_items: usize, data: usize) -> io::Result<Self> {
        Ok(Self { mapping: Mapping::new(file, offset, Self::length(list_items, data))?, list_items, data })
    }

    /// References in a list, bytes of data there is room for.
    pub fn room(&self) -> (usize, usize) {
        (self.list_items, self.data)
    }

    fn list_at(&self, list: usize, n: usize) -> *mut u32 {
        assert!(list < LISTS && n <= self.list_items, "no such list");
        self.mapping.at(4 * list * self.list_items, 4 * n).cast()
    }

    fn data_at(&self, offset: usize, bytes: usize) -> *mut u8 {
        self.mapping.at(4 * LISTS * self.list_items + offset, bytes)
    }

    /// Writes a list.
    pub fn set_list(&mut self, list: usize, items: &[u32]) {
        // SAFETY: room for n items, and the other process only reads it, in calls made after this.
        unsafe { self.list_at(list, items.len()).copy_from_nonoverlapping(items.as_ptr(), items.len()) };
    }

    /// Writes numbers as the items from `first` on.
    pub fn write(&mut self, first: usize, values: &[f64]) {
        let place = self.data_at(8 * first, 8 * values.len()).cast::<f64>();
        // SAFETY: aligned room for these numbers; the other process is not in a call.
        unsafe { place.copy_from_nonoverlapping(values.as_ptr(), values.len()) };
    }

    /// Reads numbers from item `first` on.
    pub fn read(&self, first: usize, values: &mut [f64]) {
        let place = self.data_at(8 * first, 8 * values.len()).cast::<f64>();
        // SAFETY: as many numbers lie there, aligned; any bits are a number; the other process is not in a call.
        unsafe { place.copy_to_nonoverlapping(values.as_mut_ptr(), values.len()) };
    }

    /// Writes bytes.
    pub fn write_bytes(&mut self, offset: usize, bytes: &[u8]) {
        // SAFETY: room for them; the other process is not in a call.
        unsafe { self.data_at(offset, bytes.len()).copy_from_nonoverlapping(bytes.as_ptr(), bytes.len()) };
    }

    /// Reads bytes.
    pub fn read_bytes(&self, offset: usize, length: usize) -> Vec<u8> {
        let mut bytes = vec![0; length];
        // SAFETY: as many bytes lie there; the other process is not in a call.
        unsafe { self.data_at(offset, length).copy_to_nonoverlapping(bytes.as_mut_ptr(), length) };
        bytes
    }

    /// Two lists, as number and length, and `count` numbers from item `first` on in place, while the other process waits.
    pub fn in_place(&mut self, lists: [(usize, usize); 2], first: usize, count: usize) -> ([&[u32]; 2], &mut [f64]) {
        // SAFETY: the items lie there, and the master, which waits for our answer, does not write them.
        let lists = lists.map(|(list, n)| unsafe { std::slice::from_raw_parts(self.list_at(list, n).cast_const(), n) });
        let place = self.data_at(8 * first, 8 * count).cast::<f64>();
        // SAFETY: `count` numbers lie there, aligned, behind the lists; the master does not touch them now.
        (lists, unsafe { std::slice::from_raw_parts_mut(place, count) })
    }
}

/// Integers as a list of references: the bits are what counts.
pub fn to_list(orders: &[i32]) -> &[u32] {
    // SAFETY: i32 and u32 have the same size and alignment, and any bits are a number.
    unsafe { std::slice::from_raw_parts(orders.as_ptr().cast(), orders.len()) }
}

/// The way back.
pub fn from_list(list: &[u32]) -> &[i32] {
    // SAFETY: as above.
    unsafe { std::slice::from_raw_parts(list.as_ptr().cast(), list.len()) }
}
