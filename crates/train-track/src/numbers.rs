//! A state's numbers as bytes, little endian, in the order that the state gives them.

/// Appends all numbers.
pub fn write<'a>(numbers: impl Iterator<Item = &'a f64>, bytes: &mut Vec<u8>) {
    numbers.for_each(|x| bytes.extend(x.to_le_bytes()));
}

/// Takes over what [`write`] wrote of a state with as many numbers, `count`.
///
/// # Errors
/// Another number of bytes, or a number that is not finite: no step leads to such a state.
pub fn read<'a>(bytes: &[u8], count: usize, numbers: impl Iterator<Item = &'a mut f64>) -> Result<(), String> {
    let (written, rest) = bytes.as_chunks::<8>();
    if !rest.is_empty() || written.len() != count {
        return Err("the serialized FMU state belongs to another train or track".into());
    }
    for (i, (x, bytes)) in numbers.zip(written).enumerate() {
        *x = f64::from_le_bytes(*bytes);
        if !x.is_finite() {
            return Err(format!("the serialized FMU state is damaged: number {} of the state is {x}", i + 1));
        }
    }
    Ok(())
}
