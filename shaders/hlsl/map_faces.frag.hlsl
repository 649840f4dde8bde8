// The triangle that a light sees.
struct Fragment {
    float4 position : SV_Position;
    [[vk::location(0)]] nointerpolation uint seen : TRIANGLE;
};

uint main(Fragment fragment) : SV_Target0 { return fragment.seen; }
