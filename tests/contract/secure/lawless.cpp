// Loaded before Fast DDS 2.9 it takes the place of the check of one's own rights to write, as somebody would do who has
// stolen a certificate: security::Permissions::check_create_datawriter. What others check is theirs.
extern "C" {
__attribute__((visibility("default"))) bool writes_what_it_likes() __asm__(
    "_ZN8eprosima8fastrtps4rtps8security11Permissions23check_create_datawriterERKNS2_"
    "6HandleEjRKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEERKSt6vectorISC_SaISC_EERNS2_"
    "17SecurityExceptionE");
bool writes_what_it_likes() { return true; }
}
