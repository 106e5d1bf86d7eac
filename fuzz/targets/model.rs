#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ttb_readers::model(bytes));
